#include "broadcast.h"

#include <algorithm>
#include <utility>

namespace acus::app {

void Broadcast::begin(std::string model, const Simulation& simulation) {
  scratch_ = view::build_frame_scratch(simulation);
  next_frame_.assign(view::frame_size(simulation), std::byte{0});
  frame_waits_ = false;
  shown_ = -1.0;
  waiting_.clear();
  auto first = std::make_shared<const std::string>(std::move(model));
  const std::lock_guard lock(mutex_);
  ++insertion_;
  reports_.assign(1, std::move(first));
  frame_.assign(next_frame_.size(), std::byte{0});
  frame_number_ = 0;
}

void Broadcast::keep(std::string report) {
  waiting_.push_back(std::make_shared<const std::string>(std::move(report)));
  hand_over();
}

void Broadcast::status(std::string report) {
  next_status_ = std::move(report);
  hand_over();
}

void Broadcast::show(const Simulation& simulation, double now) {
  constexpr double between = 1.0 / 60.0;  // s
  if (now - shown_ >= between) {
    view::frame_into(next_frame_, simulation, scratch_);
    frame_waits_ = true;
    shown_ = now;
  }
  hand_over();
}

// What waits, unless a client is just looking.
void Broadcast::hand_over() {
  constexpr std::size_t most = 5000;  // what a very restless hand causes beyond is not kept
  if (waiting_.empty() && next_status_.empty() && !frame_waits_) return;
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock) return;
  for (Report& report : waiting_)
    if (reports_.size() < most) reports_.push_back(std::move(report));
  waiting_.clear();
  if (!next_status_.empty()) {
    status_ = std::exchange(next_status_, {});
    ++status_number_;
  }
  if (std::exchange(frame_waits_, false)) {
    std::swap(next_frame_, frame_);
    ++frame_number_;
  }
}

void Broadcast::pass(std::string report) {
  constexpr std::size_t most = 100;
  auto shared = std::make_shared<const std::string>(std::move(report));
  const std::lock_guard lock(mutex_);
  passing_.push_back(std::move(shared));
  ++passed_;
  if (passing_.size() > most) passing_.pop_front();
}

Broadcast::Place Broadcast::beginning() const {
  const std::lock_guard lock(mutex_);
  Place place;
  place.passing = passed_;
  return place;
}

std::vector<Broadcast::Report> Broadcast::reports_since(Place& place) const {
  const std::lock_guard lock(mutex_);
  if (place.insertion != insertion_) place = {insertion_, 0, place.passing, place.status, 0};
  std::vector<Report> news(reports_.begin() + static_cast<std::ptrdiff_t>(place.report), reports_.end());
  place.report = reports_.size();
  const std::uint64_t missed =
      std::min<std::uint64_t>(passed_ - std::exchange(place.passing, passed_), passing_.size());
  news.insert(news.end(), passing_.end() - static_cast<std::ptrdiff_t>(missed), passing_.end());
  return news;
}

std::optional<std::string> Broadcast::status_since(Place& place) const {
  const std::lock_guard lock(mutex_);
  if (std::exchange(place.status, status_number_) == status_number_) return std::nullopt;
  return status_;
}

bool Broadcast::frame_since(Place& place, std::string& bytes) const {
  const std::lock_guard lock(mutex_);
  if (place.insertion != insertion_ || std::exchange(place.frame, frame_number_) == frame_number_)
    return false;
  bytes.assign(reinterpret_cast<const char*>(frame_.data()), frame_.size());
  return true;
}

}  // namespace acus::app
