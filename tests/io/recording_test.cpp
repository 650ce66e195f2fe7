// A recording gives back what was put into it, and whatever happens to its bytes, never anything else.
#include "acus/io/recording.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <sstream>

#include "acus/base/bits.h"
#include "acus/base/crc32c.h"
#include "acus/io/recording_reader.h"
#include "acus/io/replay.h"
#include "acus/io/scene_toml.h"

namespace acus::io {
namespace {

// Bits, so that no number and no zero is like another.
std::uint64_t bits(double value) { return bits_as<std::uint64_t>(value); }

std::vector<std::uint64_t> bits(const std::vector<double>& values) {
  std::vector<std::uint64_t> all;
  for (const double value : values) all.push_back(bits(value));
  return all;
}

Scene some_scene() {
  Scene scene;
  scene.needle.length = 0.171;  // m
  scene.run.time_step = 2e-3;   // s
  return scene;
}

RecordedTick some_tick(int number) {
  RecordedTick tick;
  tick.time = 0.001 * number;
  tick.position = {1e-3 * number, -0.0, 3.0};
  tick.velocity = {0.1F, 0.2F, -0.3F};
  tick.force = {-1.5F, 0.0F, 2.5F};
  tick.buttons = 1U << static_cast<unsigned>(number % 32);
  return tick;
}

std::string bytes_of(const std::vector<RecordedBlock>& blocks) {
  std::string bytes = recording_head();
  std::uint32_t checksum = recording_head_checksum();
  for (const RecordedBlock& block : blocks) bytes += block_bytes(block, checksum);
  return bytes;
}

std::vector<RecordedBlock> some_blocks() {
  return {*recorded_scene(some_scene()),
          RecordedSteps{1, {0.0, 1e-5, 2e-5}, {{1, 71}}},
          RecordedTicks{0, {some_tick(1), some_tick(2)}},
          RecordedSteps{4, {3e-5, -1e-5}, {{4, 74}, {5, 75}}},
          RecordedTicks{6, {some_tick(9)}},
          RecordedEnd{{5, 75}}};
}
const std::vector<double> some_travels = {0.0, 1e-5, 2e-5, 3e-5, -1e-5};

Result<Recording> read(const std::string& bytes) {
  std::istringstream file(bytes);
  return read_recording(file, "hand.acusrec", Ticks::read);
}

TEST(Recording, gives_back_scene_steps_hashes_and_ticks) {
  const auto read_back = read(bytes_of(some_blocks()));
  ASSERT_TRUE(read_back) << read_back.error().sentence;
  EXPECT_TRUE(read_back->whole);
  EXPECT_EQ(read_back->loss, "");
  EXPECT_EQ(scene_toml(read_back->scene), scene_toml(some_scene()));
  EXPECT_EQ(bits(read_back->travels), bits(some_travels));
  ASSERT_EQ(read_back->hashes.size(), 3U);
  EXPECT_EQ(read_back->hashes[2].step, 5U);
  EXPECT_EQ(read_back->hashes[2].hash, 75U);
  ASSERT_EQ(read_back->ticks.size(), 3U);
  const RecordedTick expected = some_tick(9), tick = read_back->ticks[2];
  EXPECT_EQ(bits(tick.time), bits(expected.time));
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(bits(tick.position[i]), bits(expected.position[i]));
    EXPECT_EQ(tick.velocity[i], expected.velocity[i]);
    EXPECT_EQ(tick.force[i], expected.force[i]);
  }
  EXPECT_EQ(tick.buttons, expected.buttons);
  EXPECT_EQ(read_back->ticks_lost, 6U);
  EXPECT_EQ(version_difference(*read_back), "");
}

TEST(Recording, gives_back_any_hand_in_any_blocks) {
  const bool held = rc::check([](const std::vector<std::vector<std::uint64_t>>& parts, std::uint64_t hash) {
    std::vector<RecordedBlock> blocks = {*recorded_scene(some_scene())};
    std::vector<std::uint64_t> all;
    for (const auto& part : parts) {
      if (part.empty()) continue;
      RecordedSteps block{all.size() + 1, {}, {{all.size() + part.size(), hash}}};
      for (const std::uint64_t travel : part) block.travels.push_back(bits_as<double>(travel));
      blocks.push_back(block);
      all.insert(all.end(), part.begin(), part.end());
    }
    blocks.push_back(RecordedEnd{{all.size(), hash}});
    const auto read_back = read(bytes_of(blocks));
    RC_ASSERT(read_back.ok());
    RC_ASSERT(read_back->whole);
    RC_ASSERT(bits(read_back->travels) == all);
    RC_ASSERT(read_back->hashes.size() == blocks.size() - 2);
  });
  EXPECT_TRUE(held);
}

// Either a sentence, or the beginning of what was recorded with a sentence about the rest.
void expect_a_beginning(const std::string& bytes, const std::string& what) {
  const auto damaged = read(bytes);
  if (!damaged) {
    EXPECT_EQ(damaged.error().sentence.rfind("hand.acusrec: ", 0), 0U) << damaged.error().sentence;
    return;
  }
  EXPECT_FALSE(damaged->whole) << what;
  EXPECT_NE(damaged->loss.find("hand.acusrec: byte "), std::string::npos) << what << damaged->loss;
  EXPECT_EQ(scene_toml(damaged->scene), scene_toml(some_scene())) << what;
  ASSERT_LE(damaged->travels.size(), some_travels.size()) << what;
  for (std::size_t i = 0; i < damaged->travels.size(); ++i)
    EXPECT_EQ(bits(damaged->travels[i]), bits(some_travels[i])) << what;
  for (const HashedStep& step : damaged->hashes) EXPECT_EQ(step.hash, 70 + step.step) << what;
  EXPECT_LE(damaged->ticks.size(), 3U) << what;
}

TEST(Recording, any_byte_that_changed_is_noticed) {
  const std::string whole = bytes_of(some_blocks());
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (const int change : {1, 2, 0x10, 0x80, 0xff}) {
      std::string bytes = whole;
      bytes[at] = static_cast<char>(bytes[at] ^ change);
      expect_a_beginning(bytes, "byte " + std::to_string(at) + " xor " + std::to_string(change));
    }
  }
}

TEST(Recording, cut_off_anywhere_it_is_a_beginning) {
  const std::string whole = bytes_of(some_blocks());
  for (std::size_t size = 0; size < whole.size(); ++size)
    expect_a_beginning(whole.substr(0, size), std::to_string(size) + " bytes");
}

// Whole blocks with whole checksums, but not in the place where they were written.
TEST(Recording, blocks_that_were_lost_doubled_or_moved_are_noticed) {
  const std::vector<RecordedBlock> blocks = some_blocks();
  std::vector<std::string> pieces;
  std::uint32_t checksum = recording_head_checksum();
  for (const RecordedBlock& block : blocks) pieces.push_back(block_bytes(block, checksum));
  const auto joined = [&](const std::vector<std::size_t>& order) {
    std::string bytes = recording_head();
    for (const std::size_t piece : order) bytes += pieces[piece];
    return bytes;
  };
  for (const std::vector<std::size_t>& order : {std::vector<std::size_t>{0, 1, 3, 4, 5},
                                                {0, 1, 1, 2, 3, 4, 5},
                                                {0, 3, 2, 1, 4, 5},
                                                {0, 1, 2, 3, 5},
                                                {0, 1, 2, 3, 4, 4, 5}})
    expect_a_beginning(joined(order), std::to_string(order.size()) + " blocks");
}

TEST(Recording, a_killed_session_is_used_up_to_where_it_ends) {
  std::vector<RecordedBlock> blocks = some_blocks();
  blocks.pop_back();
  const std::string bytes = bytes_of(blocks);
  const auto killed = read(bytes);
  ASSERT_TRUE(killed);
  EXPECT_EQ(killed->travels.size(), 5U);
  EXPECT_EQ(killed->loss, "hand.acusrec: byte " + std::to_string(bytes.size()) +
                              ": the recording ends at 0.010 s: the program that wrote it was stopped there");
}

TEST(Recording, with_a_hole_is_never_whole) {
  const auto scene = *recorded_scene(some_scene());
  const RecordedSteps before{1, {0.0, 1e-5}, {}}, behind{5, {1e-5}, {}};
  for (const std::vector<RecordedBlock>& blocks :
       {std::vector<RecordedBlock>{scene, before, RecordedGap{3}, RecordedEnd{{2, 7}}},
        {scene, before, RecordedGap{3}, behind, RecordedEnd{{5, 7}}},
        {scene, before, RecordedGap{3}},
        {scene, before, behind},
        {scene, before, scene},
        {scene, before, RecordedEnd{{3, 7}}}}) {
    const auto holed = read(bytes_of(blocks));
    ASSERT_TRUE(holed) << holed.error().sentence;
    EXPECT_FALSE(holed->whole);
    EXPECT_EQ(holed->travels.size(), 2U);
    EXPECT_NE(holed->loss.find("the recording ends at 0.004 s: "), std::string::npos) << holed->loss;
  }
}

std::string little_endian(std::uint64_t value, int size) {
  std::string bytes;
  for (int i = 0; i < size; ++i) bytes += static_cast<char>(value >> (8 * i));
  return bytes;
}

// A block with the right checksum, as whoever forges one would write it.
std::string forged(std::uint32_t kind, const std::string& payload, std::uint32_t size) {
  const std::string block = little_endian(kind, 4) + little_endian(size, 4) + payload;
  std::vector<RecordedBlock> scene = {*recorded_scene(some_scene())};
  std::uint32_t checksum = recording_head_checksum();
  block_bytes(scene[0], checksum);
  return bytes_of(scene) + block + little_endian(crc32c(block, checksum), 4);
}

TEST(Recording, counts_and_lengths_beyond_the_file_ask_for_no_memory) {
  const std::uint32_t huge = 0xffffffffU;
  const std::string count = little_endian(huge, 4);
  for (const auto& [kind, payload] : std::vector<std::pair<std::uint32_t, std::string>>{
           {1, count},
           {1, count + "text" + count},
           {2, little_endian(1, 8) + count + count},
           {2, little_endian(1, 8) + count + little_endian(0, 4) + std::string(64, 'x')},
           {2, little_endian(1, 8) + little_endian(0, 4) + count},
           {2, little_endian(1, 8) + little_endian(1, 4) + little_endian(1, 4) + std::string(24, '\xff')},
           {3, little_endian(0, 8) + count},
           {4, ""},
           {5, "short"},
           {6, ""},
           {huge, "what"}}) {
    for (const std::uint32_t size : {static_cast<std::uint32_t>(payload.size()), huge, 0x7fffffffU}) {
      const auto damaged = read(forged(kind, payload, size));
      ASSERT_TRUE(damaged) << damaged.error().sentence;
      EXPECT_FALSE(damaged->whole);
      EXPECT_EQ(damaged->travels.size(), 0U);
      EXPECT_NE(damaged->loss.find("its next block"), std::string::npos) << damaged->loss;
    }
  }
}

TEST(Recording, what_is_none_says_so) {
  EXPECT_EQ(read("").error().sentence, "hand.acusrec: the file is empty; expected a recording");
  EXPECT_NE(read("[needle]\n").error().sentence.find("byte 0: this is no recording"), std::string::npos);
  EXPECT_NE(read(recording_head()).error().sentence.find("byte 16: the scene of the recording is missing"),
            std::string::npos);
}

TEST(Recording, of_a_newer_format_is_refused_by_its_number) {
  std::string head = std::string(recording_mark) + little_endian(7, 4);
  head += little_endian(crc32c(head), 4);
  const auto newer = read(head + "whatever comes then");
  ASSERT_FALSE(newer);
  EXPECT_EQ(
      newer.error().sentence,
      "hand.acusrec: byte 8: is a recording of format 7, and this program reads format 1; use the version "
      "of acus that wrote it");
}

TEST(Recording, any_noise_behind_its_scene_is_not_believed) {
  const std::string begin = bytes_of({*recorded_scene(some_scene())});
  const bool held = rc::check([&](const std::string& noise) {
    const auto damaged = read(begin + noise);
    RC_ASSERT(damaged.ok());
    RC_ASSERT(damaged->travels.empty() && damaged->ticks.empty() && !damaged->whole);
  });
  EXPECT_TRUE(held);
}

}  // namespace
}  // namespace acus::io
