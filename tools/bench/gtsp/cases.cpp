#include "tools/bench/gtsp/cases.hpp"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <map>

#include "coverage/gtsp/gtsplib.hpp"
#include "planner/base/rng.hpp"

namespace swallowtail::bench {
namespace {

constexpr double kSide = 10'000.0;
constexpr int kClusterSize = 5;

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  for (const char c : line) {
    if (c == ',') {
      cells.emplace_back();
    } else if (c != '\r') {
      cells.back().push_back(c);
    }
  }
  return cells;
}

bool parse(const std::string& text, double& value) {
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  return code == std::errc{} && end == text.data() + text.size();
}

/// Rows under a header; every row has at least `columns` cells.
Result<std::vector<std::vector<std::string>>> read_csv(const std::filesystem::path& path,
                                                       std::size_t columns) {
  std::ifstream file(path);
  if (!file) return not_found("The file " + path.string() + " cannot be opened.");
  std::vector<std::vector<std::string>> rows;
  std::string line;
  std::getline(file, line);
  for (int number = 2; std::getline(file, line); ++number) {
    if (line.empty()) continue;
    rows.push_back(cells_of(line));
    if (rows.back().size() < columns) {
      return bad_input(path.string() + ":" + std::to_string(number) + ": has " +
                       std::to_string(rows.back().size()) + " cells; it must have " +
                       std::to_string(columns) + ".");
    }
  }
  return rows;
}

}  // namespace

Result<std::vector<GtspCase>> read_gtsp_cases(const std::filesystem::path& folder) {
  std::map<std::string, double> best_known;
  if (std::filesystem::exists(folder / "best_known.csv")) {
    const auto rows = read_csv(folder / "best_known.csv", 2);
    if (!rows) return rows.error();
    for (const auto& row : *rows) {
      if (!parse(row[1], best_known[row[0]]))
        return bad_input("The best known value of " + row[0] + " is no number.");
    }
  }
  std::vector<GtspCase> cases;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".gtsp") continue;
    auto instance = gtsp::read_gtsplib(entry.path());
    if (!instance) return instance.error();
    const std::string name = entry.path().stem().string();
    const auto known = best_known.find(name);
    cases.push_back({name, std::move(*instance), known != best_known.end() ? known->second : gtsp::kNoArc});
  }
  std::sort(cases.begin(), cases.end(), [](const GtspCase& a, const GtspCase& b) {
    const int na = a.instance.vertex_count();
    const int nb = b.instance.vertex_count();
    return na != nb ? na < nb : a.name < b.name;
  });
  return cases;
}

GtspCase generated_gtsp_case(int vertices, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<gtsp::Point> points;
  for (int v = 0; v < vertices; ++v) points.push_back({rng.uniform(0.0, kSide), rng.uniform(0.0, kSide)});
  std::vector<int> free;
  for (int v = 0; v < vertices; ++v) free.push_back(v);
  gtsp::Instance::Clusters clusters;
  while (!free.empty()) {
    const gtsp::Point centre = points[static_cast<std::size_t>(free[rng.below(free.size())])];
    const auto distance = [&](int v) {
      const double dx = points[static_cast<std::size_t>(v)].x - centre.x;
      const double dy = points[static_cast<std::size_t>(v)].y - centre.y;
      return dx * dx + dy * dy;
    };
    const std::size_t count = std::min<std::size_t>(free.size(), kClusterSize);
    std::partial_sort(free.begin(), free.begin() + static_cast<std::ptrdiff_t>(count), free.end(),
                      [&](int a, int b) { return std::pair(distance(a), a) < std::pair(distance(b), b); });
    clusters.emplace_back(free.begin(), free.begin() + static_cast<std::ptrdiff_t>(count));
    free.erase(free.begin(), free.begin() + static_cast<std::ptrdiff_t>(count));
  }
  auto instance = gtsp::Instance::from_points(std::move(clusters), std::move(points), gtsp::Metric::kEuc2D);
  return {"random" + std::to_string(vertices) + "_" + std::to_string(seed), std::move(instance).value()};
}

Result<std::vector<PeerResult>> read_peer_results(const std::filesystem::path& path) {
  const auto rows = read_csv(path, 4);
  if (!rows) return rows.error();
  std::vector<PeerResult> results;
  for (const auto& row : *rows) {
    PeerResult result{row[0], row[1]};
    if (!parse(row[2], result.gap_percent) || !parse(row[3], result.cpu_s))
      return bad_input(path.string() + ": " + row[0] + " on " + row[1] + " has a cell that is no number.");
    results.push_back(result);
  }
  return results;
}

}  // namespace swallowtail::bench
