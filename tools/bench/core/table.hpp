#pragma once

#include <string>
#include <vector>

namespace swallowtail::bench {

/// A table for people. Every row has as many cells as there are columns; the first column is aligned left,
/// the others right.
struct Table {
  std::string title;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};

std::string to_text(const Table& table);
std::string to_markdown(const Table& table);
std::string to_html(const Table& table);

/// `digits` significant ones, no exponent between 1e-4 and 1e7; "never" for an infinite value.
std::string significant(double value, int digits = 4);

}  // namespace swallowtail::bench
