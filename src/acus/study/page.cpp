#include "acus/study/page.h"

#include <algorithm>
#include <cctype>

#include "acus/study/markup.h"

namespace acus::study {
namespace {

bool is_number(const std::string& cell) {
  return !cell.empty() && cell.find_first_not_of("0123456789.+- %<e") == std::string::npos &&
         std::any_of(cell.begin(), cell.end(), [](unsigned char c) { return std::isdigit(c); });
}

// A column of numbers, where cells may be empty, is set to the right with its head.
bool is_number_column(const Table& table, std::size_t column) {
  bool any = false;
  for (const auto& row : table.rows) {
    if (column >= row.size() || row[column].empty() || row[column] == "-") continue;
    if (!is_number(row[column])) return false;
    any = true;
  }
  return any;
}

std::string element(const Table& table) {
  std::vector<const char*> look;
  for (std::size_t i = 0; i < table.head.size(); ++i)
    look.push_back(is_number_column(table, i) ? " class=\"number\"" : "");
  constexpr std::size_t many = 10;  // columns that need smaller letters to stand beside each other
  std::string out = table.head.size() > many ? "<div class=\"scroll\"><table class=\"wide\">\n"
                                             : "<div class=\"scroll\"><table>\n";
  if (!table.caption.empty()) out += joined({"<caption>", escaped(table.caption), "</caption>\n"});
  out += "<thead><tr>";
  for (std::size_t i = 0; i < table.head.size(); ++i)
    out += joined({"<th scope=\"col\"", look[i], ">", escaped(table.head[i]), "</th>"});
  out += "</tr></thead>\n<tbody>\n";
  for (const auto& row : table.rows) {
    out += "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i)
      out += joined(
          {i == 0 ? "<th scope=\"row\"" : "<td", look[i], ">", escaped(row[i]), i == 0 ? "</th>" : "</td>"});
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

}  // namespace

void Page::heading(int level, const std::string& id, const std::string& words) {
  const std::string tag = joined({"h", std::to_string(level)});
  body_ += joined({"<", tag, " id=\"", escaped(id), "\">", escaped(words), "</", tag, ">\n"});
  if (level == 2) contents_ += joined({"<li><a href=\"#", escaped(id), "\">", escaped(words), "</a></li>\n"});
}

void Page::paragraphs(const std::string& words) {
  for (std::size_t from = 0; from < words.size();) {
    const std::size_t end = std::min(words.find("\n\n", from), words.size());
    const std::string_view part = std::string_view(words).substr(from, end - from);
    if (part.find_first_not_of(" \n") != std::string_view::npos)
      body_ += joined({"<p>", escaped(part), "</p>\n"});
    from = end + 2;
  }
}

void Page::note(const std::string& words) {
  body_ += joined({"<p class=\"note\">", escaped(words), "</p>\n"});
}

void Page::list(const std::vector<std::string>& items) {
  body_ += "<ul>\n";
  for (const std::string& item : items) body_ += joined({"<li>", escaped(item), "</li>\n"});
  body_ += "</ul>\n";
}

void Page::table(const Table& table) { body_ += element(table); }

void Page::figure(const std::string& name, const Svg& svg, const std::string& caption,
                  const std::vector<Table>& data) {
  pictures_.push_back({joined({name, ".svg"}), svg.document()});
  body_ += joined({"<figure>\n", svg.inline_element(), "<figcaption><b>Figure ", std::to_string(++figures_),
                   ".</b> ", escaped(caption), "</figcaption>\n"});
  if (!data.empty()) {
    body_ += "<details><summary>Numbers of this figure</summary>\n";
    for (const Table& one : data) body_ += element(one);
    body_ += "</details>\n";
  }
  body_ += "</figure>\n";
}

void Page::begin_row() { body_ += "<div class=\"row\">\n"; }
void Page::end_row() { body_ += "</div>\n"; }

std::string Page::document() const {
  return joined({"<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n",
                 "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n",
                 "<meta name=\"color-scheme\" content=\"light dark\">\n<title>", escaped(title_),
                 "</title>\n<style>\n", page_style(), picture_style(),
                 "</style>\n</head>\n<body>\n<main>\n<h1>", escaped(title_), "</h1>\n",
                 "<nav aria-label=\"Contents\"><ol>\n", contents_, "</ol></nav>\n", body_,
                 "</main>\n</body>\n</html>\n"});
}

}  // namespace acus::study
