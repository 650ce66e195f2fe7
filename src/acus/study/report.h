// The report of a study: one HTML file that a person can read without the program, and its pictures as files.
#pragma once

#include <string>
#include <vector>

#include "acus/study/page.h"
#include "acus/study/results_csv.h"

namespace acus::study {

struct Report {
  std::string html;
  std::vector<PictureFile> pictures;
};

Report build_report(const Study& study, const std::vector<GroupRecords>& groups);

}  // namespace acus::study
