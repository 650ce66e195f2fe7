#include "acus/io/recording.h"

#include "acus/base/bits.h"
#include "acus/base/crc32c.h"

namespace acus::io {
namespace {

enum Kind : std::uint32_t { scene = 1, steps = 2, ticks = 3, gap = 4, end = 5 };

constexpr std::size_t number_size = 8, hashed_step_size = 16, tick_size = 60;

class Encoder {
 public:
  void u32(std::uint32_t value) { little_endian(value, 4); }
  void u64(std::uint64_t value) { little_endian(value, 8); }
  void f32(float value) { u32(bits_as<std::uint32_t>(value)); }
  void f64(double value) { u64(bits_as<std::uint64_t>(value)); }
  void text(std::string_view value) {
    u32(static_cast<std::uint32_t>(value.size()));
    bytes += value;
  }
  void hashed_step(const HashedStep& value) {
    u64(value.step);
    u64(value.hash);
  }
  void tick(const RecordedTick& value) {
    f64(value.time);
    for (const double x : value.position) f64(x);
    for (const float x : value.velocity) f32(x);
    for (const float x : value.force) f32(x);
    u32(value.buttons);
  }

  std::string bytes;

 private:
  void little_endian(std::uint64_t value, int size) {
    for (int i = 0; i < size; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xffU);
  }
};

// Reads what Encoder writes. Past the end it gives zeros and is no longer `whole`.
class Decoder {
 public:
  explicit Decoder(std::string_view bytes) : bytes_(bytes) {}

  std::uint32_t u32() { return static_cast<std::uint32_t>(little_endian(4)); }
  std::uint64_t u64() { return little_endian(8); }
  float f32() { return bits_as<float>(u32()); }
  double f64() { return bits_as<double>(u64()); }
  std::string text() { return std::string(taken(u32())); }
  HashedStep hashed_step() {
    const std::uint64_t step = u64();
    return {step, u64()};
  }
  RecordedTick tick() {
    RecordedTick value;
    value.time = f64();
    for (double& x : value.position) x = f64();
    for (float& x : value.velocity) x = f32();
    for (float& x : value.force) x = f32();
    value.buttons = u32();
    return value;
  }

  // Everything was there, and nothing is left.
  bool used_up() const { return whole_ && bytes_.empty(); }
  // Whether `left` more bytes are all there is: asked before a count of things is believed.
  bool has_left(std::uint64_t left) const { return whole_ && bytes_.size() == left; }

 private:
  std::string_view taken(std::size_t size) {
    whole_ = whole_ && size <= bytes_.size();
    const std::string_view part = whole_ ? bytes_.substr(0, size) : std::string_view();
    bytes_.remove_prefix(part.size());
    return part;
  }
  std::uint64_t little_endian(std::size_t size) {
    std::uint64_t value = 0;
    int place = 0;
    for (const char byte : taken(size))
      value |= static_cast<std::uint64_t>(static_cast<unsigned char>(byte)) << (8 * place++);
    return value;
  }

  std::string_view bytes_;
  bool whole_ = true;
};

struct PayloadWriter {
  Encoder& to;

  Kind operator()(const RecordedScene& block) const {
    to.text(block.scene);
    to.text(block.versions);
    to.u64(block.mesh_hash);
    return scene;
  }
  Kind operator()(const RecordedSteps& block) const {
    to.u64(block.first);
    to.u32(static_cast<std::uint32_t>(block.travels.size()));
    to.u32(static_cast<std::uint32_t>(block.hashes.size()));
    for (const double travel : block.travels) to.f64(travel);
    for (const HashedStep& step : block.hashes) to.hashed_step(step);
    return steps;
  }
  Kind operator()(const RecordedTicks& block) const {
    to.u64(block.lost);
    to.u32(static_cast<std::uint32_t>(block.ticks.size()));
    for (const RecordedTick& tick : block.ticks) to.tick(tick);
    return ticks;
  }
  Kind operator()(const RecordedGap& block) const {
    to.u64(block.step);
    return gap;
  }
  Kind operator()(const RecordedEnd& block) const {
    to.hashed_step(block.last);
    return end;
  }
};

std::optional<RecordedBlock> scene_of(Decoder from) {
  RecordedScene block;
  block.scene = from.text();
  block.versions = from.text();
  block.mesh_hash = from.u64();
  if (!from.used_up()) return std::nullopt;
  return block;
}

std::optional<RecordedBlock> steps_of(Decoder from) {
  RecordedSteps block;
  block.first = from.u64();
  const std::uint64_t travels = from.u32(), hashes = from.u32();
  if (travels == 0 || !from.has_left(travels * number_size + hashes * hashed_step_size)) return std::nullopt;
  for (std::uint64_t i = 0; i < travels; ++i) block.travels.push_back(from.f64());
  std::uint64_t least = block.first;
  for (std::uint64_t i = 0; i < hashes; ++i) {
    const HashedStep step = from.hashed_step();
    if (step.step < least || step.step - block.first >= travels) return std::nullopt;
    least = step.step + 1;
    block.hashes.push_back(step);
  }
  return block;
}

std::optional<RecordedBlock> ticks_of(Decoder from) {
  RecordedTicks block;
  block.lost = from.u64();
  const std::uint64_t count = from.u32();
  if (!from.has_left(count * tick_size)) return std::nullopt;
  for (std::uint64_t i = 0; i < count; ++i) block.ticks.push_back(from.tick());
  return block;
}

}  // namespace

std::string recording_head() {
  Encoder head;
  head.bytes = recording_mark;
  head.u32(recording_format);
  head.u32(crc32c(head.bytes));
  return head.bytes;
}

std::uint32_t recording_head_checksum() {
  return little_endian_32(recording_head().substr(recording_head_size - 4));
}

std::string block_bytes(const RecordedBlock& block, std::uint32_t& so_far) {
  Encoder payload, whole;
  whole.u32(std::visit(PayloadWriter{payload}, block));
  whole.text(payload.bytes);
  so_far = crc32c(whole.bytes, so_far);
  whole.u32(so_far);
  return whole.bytes;
}

BlockHead block_head(std::string_view bytes) {
  return {little_endian_32(bytes), little_endian_32(bytes.substr(4))};
}

std::uint32_t little_endian_32(std::string_view bytes) { return Decoder(bytes.substr(0, 4)).u32(); }

std::optional<RecordedBlock> block_of(std::uint32_t kind, std::string_view payload) {
  Decoder from(payload);
  switch (kind) {
    case scene:
      return scene_of(from);
    case steps:
      return steps_of(from);
    case ticks:
      return ticks_of(from);
    case gap: {
      const RecordedGap block{from.u64()};
      if (from.used_up()) return block;
      return std::nullopt;
    }
    case end: {
      const RecordedEnd block{from.hashed_step()};
      if (from.used_up()) return block;
      return std::nullopt;
    }
    default:
      return std::nullopt;
  }
}

}  // namespace acus::io
