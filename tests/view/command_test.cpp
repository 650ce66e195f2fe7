#include "acus/view/command.h"

#include <gtest/gtest.h>

#include <random>

namespace acus::view {
namespace {

template <class Kind>
Kind parsed(const std::string& text) {
  const Result<Command> command = parse_command(text);
  if (!command.ok()) {
    ADD_FAILURE() << command.error().sentence;
    return Kind{};
  }
  if (const Kind* kind = std::get_if<Kind>(&*command)) return *kind;
  ADD_FAILURE() << text << " is read as another command";
  return Kind{};
}

// The sentence a text is refused with; empty if it is taken.
std::string refusal(const std::string& text) {
  const Result<Command> command = parse_command(text);
  return command ? "" : command.error().sentence;
}

TEST(Command, every_one_of_the_protocol_is_read_with_its_members) {
  const Start start = parsed<Start>(R"({"type": "start", "scene": "[needle]", "settings": ["a=1", "b=2"]})");
  EXPECT_EQ(start.scene.toml, "[needle]");
  EXPECT_EQ(start.scene.settings, (std::vector<std::string>{"a=1", "b=2"}));
  EXPECT_EQ(parsed<Check>(R"({"type": "check", "scene": "x"})").scene.toml, "x");
  EXPECT_EQ(parsed<Push>(R"({"type": "push", "travel_m": -0.02})").travel, -0.02);
  EXPECT_EQ(parsed<Steady>(R"({"speed_m_s": 0.01, "type": "steady"})").speed, 0.01);
  parsed<Pause>(R"({"type": "pause"})");
  parsed<Resume>(R"({"type": "resume"})");
  EXPECT_EQ(parsed<Step>(R"({"type": "step", "steps": 3})").steps, 3);
  EXPECT_EQ(parsed<Rate>(R"({"type": "rate", "factor": 0.25})").factor, 0.25);
  parsed<Arm>(R"({"type": "arm"})");
  parsed<Disarm>(R"({"type": "disarm"})");
}

TEST(Command, what_is_wrong_is_said_in_a_sentence_that_names_it) {
  const std::pair<const char*, const char*> wrong[] = {
      {"", "is not JSON"},
      {"{", "is not JSON"},
      {"\xff\xfe", "is not JSON"},
      {R"({"type": "pause"} and more)", "is not JSON"},
      {"[]", "object with a \"type\""},
      {"7", "object with a \"type\""},
      {"null", "object with a \"type\""},
      {"{}", "object with a \"type\""},
      {R"({"type": 4})", "object with a \"type\""},
      {R"({"type": "jump"})", "no command \"jump\""},
      {R"({"type": "start"})", "\"scene\""},
      {R"({"type": "start", "scene": 5})", "\"scene\""},
      {R"({"type": "check", "scene": "", "settings": "a=1"})", "\"settings\""},
      {R"({"type": "check", "scene": "", "settings": [1]})", "\"settings\""},
      {R"({"type": "push"})", "\"travel_m\""},
      {R"({"type": "push", "travel_m": "far"})", "\"travel_m\""},
      {R"({"type": "push", "travel_m": 1e300})", "from -10 to 10"},
      {R"({"type": "push", "travel_m": null})", "\"travel_m\""},
      {R"({"type": "steady", "speed_m_s": [1]})", "\"speed_m_s\""},
      {R"({"type": "step", "steps": 0})", "\"steps\""},
      {R"({"type": "step", "steps": 1.5})", "whole"},
      {R"({"type": "step", "steps": 1e300})", "from 1 to 100000"},
      {R"({"type": "step", "steps": 1e400})", "is not JSON"},
      {R"({"type": "step", "steps": NaN})", "is not JSON"},
      {R"({"type": "rate", "factor": 2})", "\"factor\""},
      {R"({"type": "rate", "factor": 0})", "\"factor\""},
  };
  for (const auto& [text, part] : wrong)
    EXPECT_NE(refusal(text).find(part), std::string::npos) << text << ": " << refusal(text);
}

TEST(Command, deep_and_endless_texts_are_refused_before_they_are_read) {
  EXPECT_NE(refusal(std::string(1000000, '[')).find("levels"), std::string::npos);
  EXPECT_NE(refusal(std::string(longest_command + 1, ' ')).find("longer"), std::string::npos);
  // Brackets in a string are text.
  EXPECT_EQ(
      parsed<Check>("{\"type\": \"check\", \"scene\": \"" + std::string(100, '[') + "\\\"\"}").scene.toml,
      std::string(100, '[') + "\"");
}

// Whatever becomes of a command on its way, there is an answer. (The sanitizers look on.)
TEST(Command, damaged_texts_are_read_or_refused) {
  std::mt19937 random(7);
  const std::string whole =
      R"({"type": "start", "scene": "[needle]\nlength_mm = 2", "settings": ["a=1", "b"]})";
  for (int i = 0; i < 20000; ++i) {
    std::string text = whole.substr(0, random() % (whole.size() + 1));
    for (unsigned k = random() % 4; k > 0 && !text.empty(); --k)
      text[random() % text.size()] = static_cast<char>(random() % 256);
    if (const Result<Command> command = parse_command(text); !command) {
      ASSERT_FALSE(command.error().sentence.empty());
    }
  }
}

}  // namespace
}  // namespace acus::view
