// "Did you mean": the nearest of the words that would have been right.
#pragma once

#include <string>
#include <vector>

namespace acus::io {

// Number of letters to insert, delete or replace to turn one word into the other (Levenshtein).
int edit_distance(const std::string& a, const std::string& b);

// The nearest known word, or empty when none is near. Words with a dot also match by what follows it, so that
// a key in the wrong table, or without its unit, finds its home.
std::string nearest_word(const std::string& word, const std::vector<std::string>& known);

}  // namespace acus::io
