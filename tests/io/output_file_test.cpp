#include "acus/io/output_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace acus::io {
namespace {

// /dev/full takes every byte until it must keep one: a disk that is full.
TEST(OutputFile, a_full_disk_is_told_at_the_end_at_the_latest) {
  auto file = OutputFile::create("/dev/full");
  ASSERT_TRUE(file);
  file->write("a row\n");
  const auto failed = file->close();
  ASSERT_TRUE(failed);
  EXPECT_EQ(failed->sentence.find("/dev/full: cannot be written to its end: the disk is full"), 0U)
      << failed->sentence;
}

TEST(OutputFile, a_file_in_place_of_a_folder_is_named) {
  const std::string path = ::testing::TempDir() + "acus_output_file_test";
  ASSERT_FALSE(write_file(path, "text"));
  const auto failed = make_folder(path);
  ASSERT_TRUE(failed);
  EXPECT_EQ(failed->sentence, path + ": is a file; name a folder to write into");
  EXPECT_TRUE(make_folder(path + "/below"));
  std::filesystem::remove(path);
}

TEST(OutputFile, a_full_disk_leaves_the_file_that_was_there) {
  const std::string path = ::testing::TempDir() + "acus_whole_file_test";
  ASSERT_FALSE(write_file(path, "of yesterday"));
  std::filesystem::create_symlink("/dev/full", path + ".part");
  EXPECT_TRUE(write_file(path, "of today"));
  std::ifstream kept(path);
  std::string text;
  std::getline(kept, text);
  EXPECT_EQ(text, "of yesterday");
  EXPECT_FALSE(std::filesystem::exists(path + ".part"));
  ASSERT_FALSE(write_file(path, "of today"));
  std::getline(std::ifstream(path), text);
  EXPECT_EQ(text, "of today");
  std::filesystem::remove(path);
}

TEST(OutputFile, a_name_too_long_for_a_folder_is_a_sentence) {
  const auto failed = make_folder(::testing::TempDir() + std::string(300, 'x'));
  ASSERT_TRUE(failed);
  EXPECT_NE(failed->sentence.find("this folder cannot be made: File name too long"), std::string::npos)
      << failed->sentence;
}

TEST(OutputFile, a_folder_in_place_of_a_file_is_named) {
  const auto file = OutputFile::create(::testing::TempDir());
  ASSERT_FALSE(file);
  EXPECT_NE(file.error().sentence.find("a folder of that name stands in its place"), std::string::npos);
}

}  // namespace
}  // namespace acus::io
