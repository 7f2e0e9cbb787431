#pragma once

#include <string>
#include <utility>
#include <vector>

namespace swallowtail::report {

struct Figure {
  std::string file;  ///< name of its SVG file beside the page
  std::string caption;
  std::string svg;
};

struct Page {
  std::string title;
  std::string verdict;  ///< one sentence
  bool good = false;
  std::vector<std::pair<std::string, std::string>> facts;  ///< name, value with unit
  std::vector<std::vector<std::string>> violations;        ///< time, kind, by, detail
  std::vector<Figure> figures;
  std::string footnote;
};

/// One page that needs nothing from outside.
std::string draw_page(const Page& page);

}  // namespace swallowtail::report
