#include "tools/bench/core/report.hpp"

#include <cmath>

#include <fmt/core.h>

#include "tools/drawing/svg.hpp"

namespace swallowtail::bench {
namespace {

constexpr const char* kStyle =
    "body{font:14px/1.45 system-ui,sans-serif;margin:2em auto;max-width:1100px;color:#1b2733}"
    "table{border-collapse:collapse;font-size:13px}th,td{padding:.25em .7em;text-align:right;"
    "border-bottom:1px solid #d9e0e6}th:first-child,td:first-child{text-align:left}"
    "figure{margin:1.5em 0}svg{max-width:100%;border:1px solid #d9e0e6}figcaption,footer{color:#5b6b7a}";

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string safe = "\"";
  for (const char c : text) safe += c == '"' ? std::string("\"\"") : std::string(1, c);
  return safe + "\"";
}

}  // namespace

const std::vector<std::string>& report_extensions() {
  static const std::vector<std::string> extensions{".csv", ".json", ".md", ".html"};
  return extensions;
}

nlohmann::ordered_json to_json(const Report& report, const Environment& environment) {
  nlohmann::ordered_json json{{"bench", report.bench}, {"status", report.status}};
  for (const auto& [name, value] : environment) json["environment"][name] = value;
  json["notes"] = report.notes;
  json["rows"] = nlohmann::ordered_json::array();
  for (const Row& row : report.rows) {
    nlohmann::ordered_json value = nullptr;
    if (std::isfinite(row.value)) value = row.value;
    json["rows"].push_back({{"subject", row.subject},
                            {"case", row.case_name},
                            {"seed", row.seed},
                            {"metric", row.metric},
                            {"value", value},
                            {"unit", row.unit}});
  }
  for (const auto& [key, value] : report.extra.items()) json[key] = value;
  return json;
}

std::string to_csv(const Report& report, const Environment& environment) {
  std::string text;
  for (const auto& [name, value] : environment) text += "# " + name + ": " + value + "\n";
  for (const std::string& note : report.notes) text += "# " + note + "\n";
  text += "subject,case,seed,metric,value,unit\n";
  for (const Row& row : report.rows) {
    text += fmt::format("{},{},{},{},{},{}\n", quoted(row.subject), quoted(row.case_name), row.seed,
                        quoted(row.metric), row.value, quoted(row.unit));
  }
  return text;
}

std::string to_markdown(const Report& report, const Environment& environment) {
  std::string text = "## swallowtail bench " + report.bench + "\n\n";
  for (const auto& [name, value] : environment) text += "- " + name + ": " + value + "\n";
  for (const Table& table : report.tables) text += "\n" + to_markdown(table);
  if (!report.notes.empty()) text += "\n";
  for (const std::string& note : report.notes) text += "- " + note + "\n";
  return text;
}

std::string to_html(const Report& report, const Environment& environment) {
  const std::string title = "swallowtail bench " + report::escaped(report.bench);
  std::string text = "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>" + title +
                     "</title><style>" + kStyle + "</style></head><body>\n<h1>" + title + "</h1>\n";
  for (const Table& table : report.tables) text += to_html(table);
  for (const Figure& figure : report.figures) {
    text += "<figure>\n" + figure.svg + "<figcaption>" + report::escaped(figure.caption) +
            "</figcaption></figure>\n";
  }
  text += "<ul>\n";
  for (const std::string& note : report.notes) text += "<li>" + report::escaped(note) + "</li>\n";
  text += "</ul>\n<footer>";
  for (const auto& [name, value] : environment) text += report::escaped(name + ": " + value) + "<br>\n";
  return text + "</footer>\n</body></html>\n";
}

cli::Answer answer_of(const Report& report) {
  const Environment environment = this_environment();
  cli::Answer answer;
  answer.json = to_json(report, environment);
  for (const Table& table : report.tables) answer.table += to_text(table) + "\n";
  for (const std::string& note : report.notes) answer.table += note + "\n";
  answer.files[".csv"] = [report, environment] { return to_csv(report, environment); };
  answer.files[".md"] = [report, environment] { return to_markdown(report, environment); };
  answer.files[".html"] = [report, environment] { return to_html(report, environment); };
  return answer;
}

}  // namespace swallowtail::bench
