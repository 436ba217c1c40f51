// Tables of the documentation that are derived from the library's tables.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "source_dir.h"

namespace scarp::test {

struct DocsTable {
  std::string head;  ///< start of the first line, also in the page
  std::string text;
};

/// Fails unless the page ("docs/formats.md") contains the tables. With SCARP_UPDATE_DOCS=1 it updates them. `tests`:
/// the filter that runs this test.
inline void expect_tables(const std::string& page, const std::vector<DocsTable>& tables, const std::string& tests) {
  const std::string path = source_dir() + "/" + page;
  std::stringstream read;
  read << std::ifstream(path).rdbuf();
  const std::string text = read.str();
  std::string made = text;
  for (const DocsTable& table : tables) {
    const std::size_t begin = made.find(table.head), end = made.find("\n\n", begin);
    ASSERT_TRUE(begin != std::string::npos && end != std::string::npos) << page << " has no table " << table.head;
    made = made.substr(0, begin) + table.text + made.substr(end + 1);
  }
  const char* update = std::getenv("SCARP_UPDATE_DOCS");
  if (update != nullptr && std::string(update) == "1") std::ofstream(path) << made;
  EXPECT_TRUE(made == text || update != nullptr)
      << page
      << " is not the library's table; write it with\n  SCARP_UPDATE_DOCS=1 build/bin/scarp_tests --gtest_filter='"
      << tests << "'";
}

}  // namespace scarp::test
