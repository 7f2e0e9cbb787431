#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "tools/bench/core/environment.hpp"
#include "tools/bench/core/row.hpp"
#include "tools/bench/core/table.hpp"
#include "tools/cli/output.hpp"

namespace swallowtail::bench {

struct Figure {
  std::string caption;
  std::string svg;
};

/// What a bench command hands over in every form that it can be asked for.
struct Report {
  std::string bench;   ///< "plan", "gtsp"
  std::string status;  ///< "done", "interrupted"
  std::vector<std::string> notes;
  std::vector<Row> rows;
  std::vector<Table> tables;
  std::vector<Figure> figures;                                      ///< in HTML only
  nlohmann::ordered_json extra = nlohmann::ordered_json::object();  ///< added to the document's top level
};

/// Endings that -o takes.
const std::vector<std::string>& report_extensions();

/// {bench, status, environment: {…}, notes: […], rows: [{subject, case, seed, metric, value, unit}], …extra};
/// a value that is infinite (never reached) is null.
nlohmann::ordered_json to_json(const Report& report, const Environment& environment);
/// One line for each row under a header; the environment and the notes stand before it in lines that begin
/// with '#'. A value never reached is "inf".
std::string to_csv(const Report& report, const Environment& environment);
std::string to_markdown(const Report& report, const Environment& environment);
std::string to_html(const Report& report, const Environment& environment);

/// The forms as `cli::deliver` takes them.
cli::Answer answer_of(const Report& report);

}  // namespace swallowtail::bench
