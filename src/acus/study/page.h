// Page: one self-contained HTML document, written from top to bottom; nothing in it comes from the network.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "acus/study/svg.h"

namespace acus::study {

struct Table {
  std::string caption;
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;  // cells that are numbers are set to the right
};

// A picture as a file of its own.
struct PictureFile {
  std::string name;  // without folder
  std::string svg;
};

class Page {
 public:
  explicit Page(std::string title) : title_(std::move(title)) {}

  // `id` is what links point to; headings of the second level make the contents.
  void heading(int level, const std::string& id, const std::string& words);
  // Plain words; an empty line in them begins a new paragraph.
  void paragraphs(const std::string& words);
  void note(const std::string& words);  // small and quiet
  void list(const std::vector<std::string>& items);
  void table(const Table& table);
  // A picture with its caption and, folded away, its data. Also kept as the file `name`.svg.
  void figure(const std::string& name, const Svg& svg, const std::string& caption,
              const std::vector<Table>& data);
  // Figures between these stand beside each other where the page is wide enough.
  void begin_row();
  void end_row();

  std::string document() const;
  const std::vector<PictureFile>& pictures() const { return pictures_; }

 private:
  std::string title_, body_, contents_;
  std::vector<PictureFile> pictures_;
  int figures_ = 0;
};

std::string page_style();

}  // namespace acus::study
