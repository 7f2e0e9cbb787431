#include "tools/mission/report/html.hpp"

#include "tools/drawing/svg.hpp"

namespace swallowtail::report {
namespace {

constexpr const char* kStyle = R"(
body{font:15px/1.45 system-ui,sans-serif;color:#1b2733;background:#f6f8f9;margin:0 auto;max-width:960px;padding:24px}
h1{font-size:24px;margin:0 0 8px}
.verdict{padding:10px 14px;border-radius:6px;font-weight:600}
.good{background:#dff2e1;color:#17562a}.bad{background:#fbe3e0;color:#8a1f14}
dl{display:grid;grid-template-columns:repeat(auto-fill,minmax(200px,1fr));gap:10px;margin:18px 0}
dl div{background:#fff;border:1px solid #d9e0e6;border-radius:6px;padding:8px 12px}
dt{color:#5b6b7a;font-size:13px}dd{margin:0;font-size:19px;font-weight:600}
figure{margin:22px 0;background:#fff;border:1px solid #d9e0e6;border-radius:6px;padding:10px}
figure svg{width:100%;height:auto;display:block}figcaption{color:#5b6b7a;font-size:13px;padding-top:6px}
table{border-collapse:collapse;width:100%;background:#fff}td,th{border:1px solid #d9e0e6;padding:4px 8px;text-align:left;font-size:13px}
footer{color:#5b6b7a;font-size:13px;margin-top:24px}
)";

std::string violations_table(const std::vector<std::vector<std::string>>& rows) {
  if (rows.empty()) return {};
  std::string html =
      "<h2>Violations</h2>\n<table><tr><th>time, s</th><th>kind</th><th>by</th><th>detail</th></tr>\n";
  for (const auto& row : rows) {
    html += "<tr>";
    for (const auto& cell : row) html += "<td>" + escaped(cell) + "</td>";
    html += "</tr>\n";
  }
  return html + "</table>\n";
}

}  // namespace

std::string draw_page(const Page& page) {
  std::string html =
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width\"><title>" +
      escaped(page.title) + "</title><style>" + kStyle + "</style></head><body>\n<h1>" + escaped(page.title) +
      "</h1>\n<p class=\"verdict " + (page.good ? "good" : "bad") + "\">" + escaped(page.verdict) +
      "</p>\n<dl>\n";
  for (const auto& [name, value] : page.facts)
    html += "<div><dt>" + escaped(name) + "</dt><dd>" + escaped(value) + "</dd></div>\n";
  html += "</dl>\n" + violations_table(page.violations);
  for (const auto& figure : page.figures)
    html += "<figure>\n" + figure.svg + "<figcaption>" + escaped(figure.caption) + "</figcaption></figure>\n";
  return html + "<footer>" + escaped(page.footnote) + "</footer>\n</body></html>\n";
}

}  // namespace swallowtail::report
