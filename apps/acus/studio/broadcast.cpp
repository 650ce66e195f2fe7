#include "broadcast.h"

#include <algorithm>
#include <utility>

namespace acus::app {

void Broadcast::begin(std::string model, const Simulation& simulation) {
  scratch_ = view::build_frame_scratch(simulation);
  spare_.assign(view::frame_size(simulation), std::byte{0});
  shown_ = -1.0;
  const std::lock_guard lock(mutex_);
  ++insertion_;
  reports_.assign(1, std::move(model));
  frame_.assign(spare_.size(), std::byte{0});
  frame_number_ = 0;
}

void Broadcast::keep(std::string report) {
  constexpr std::size_t most = 5000;  // what a very restless hand causes beyond is not kept
  const std::lock_guard lock(mutex_);
  if (reports_.size() < most) reports_.push_back(std::move(report));
}

void Broadcast::pass(std::string report) {
  constexpr std::size_t most = 100;
  const std::lock_guard lock(mutex_);
  passing_.push_back(std::move(report));
  ++passed_;
  if (passing_.size() > most) passing_.pop_front();
}

void Broadcast::status(std::string report) {
  const std::lock_guard lock(mutex_);
  status_ = std::move(report);
  ++status_number_;
}

void Broadcast::show(const Simulation& simulation, double now) {
  constexpr double between = 1.0 / 60.0;  // s
  if (now - shown_ < between) return;
  view::frame_into(spare_, simulation, scratch_);
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock) return;
  std::swap(spare_, frame_);
  ++frame_number_;
  shown_ = now;
}

Broadcast::Place Broadcast::beginning() const {
  const std::lock_guard lock(mutex_);
  Place place;
  place.passing = passed_;
  return place;
}

std::vector<std::string> Broadcast::reports_since(Place& place) const {
  const std::lock_guard lock(mutex_);
  if (place.insertion != insertion_) place = {insertion_, 0, place.passing, place.status, 0};
  std::vector<std::string> news(reports_.begin() + static_cast<std::ptrdiff_t>(place.report), reports_.end());
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
