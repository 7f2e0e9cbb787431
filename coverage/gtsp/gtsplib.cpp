#include "coverage/gtsp/gtsplib.hpp"

#include <array>
#include <fstream>
#include <optional>
#include <string_view>

#include "coverage/gtsp/detail/token_reader.hpp"
#include "planner/base/checks.hpp"

namespace swallowtail::gtsp {
namespace {

using detail::TokenReader;
using detail::upper_case;

/// Keys and sections that say nothing about the instance.
constexpr std::array<std::string_view, 8> kIgnoredKeys = {
    "NAME",     "COMMENT",          "NODE_COORD_TYPE",      "DISPLAY_DATA_TYPE",
    "CAPACITY", "EDGE_DATA_FORMAT", "DISPLAY_DATA_SECTION", "FIXED_EDGES_SECTION"};

constexpr double kMostCoordinate = 1e11;

/// Ctrl-Z, with which files from old systems end.
constexpr std::string_view kEndOfText = "\x1a";

std::optional<Metric> metric_named(const std::string& name) {
  if (name == "EUC_2D") return Metric::kEuc2D;
  if (name == "CEIL_2D") return Metric::kCeil2D;
  if (name == "GEO") return Metric::kGeo;
  if (name == "GEOM") return Metric::kGeom;
  if (name == "ATT") return Metric::kAtt;
  return std::nullopt;
}

/// Which columns of row i a format lists, as [first, end); symmetric formats list one triangle.
struct MatrixFormat {
  enum class Shape { kFull, kUpper, kLower, kUpperDiagonal, kLowerDiagonal };
  Shape shape = Shape::kFull;

  static std::optional<MatrixFormat> named(const std::string& name) {
    if (name == "FULL_MATRIX") return MatrixFormat{Shape::kFull};
    if (name == "UPPER_ROW" || name == "LOWER_COL") return MatrixFormat{Shape::kUpper};
    if (name == "LOWER_ROW" || name == "UPPER_COL") return MatrixFormat{Shape::kLower};
    if (name == "UPPER_DIAG_ROW" || name == "LOWER_DIAG_COL") return MatrixFormat{Shape::kUpperDiagonal};
    if (name == "LOWER_DIAG_ROW" || name == "UPPER_DIAG_COL") return MatrixFormat{Shape::kLowerDiagonal};
    return std::nullopt;
  }
  int first(int row) const {
    if (shape == Shape::kUpper) return row + 1;
    return shape == Shape::kUpperDiagonal ? row : 0;
  }
  int end(int row, int n) const {
    if (shape == Shape::kLower) return row;
    return shape == Shape::kLowerDiagonal ? row + 1 : n;
  }
};

class GtsplibReader {
 public:
  GtsplibReader(std::istream& in, const std::string& name) : reader_(in, name) {}

  Result<Instance> read() {
    auto line = reader_.next_line();
    for (; line && line->key != "EOF"; line = reader_.next_line()) {
      if (is_skipping_ && (line->key.empty() || line->key.front() < 'A')) continue;
      is_skipping_ = false;
      if (Status s = read_entry(*line); !s) return s.error();
    }
    if (line) {
      if (const auto rest = reader_.next_line()) {
        if (rest->key != "EOF" && !(rest->key.empty() && rest->value == kEndOfText))
          return reader_.error("EOF", rest->key + " " + rest->value, "nothing may follow it");
      }
    }
    return assembled();
  }

 private:
  Status read_entry(const TokenReader::Line& line) {
    if (line.key == "NODE_COORD_SECTION") return read_points();
    if (line.key == "EDGE_WEIGHT_SECTION") return read_weights();
    if (line.key == "GTSP_SET_SECTION") return read_sets();
    return read_header(line);
  }

  Status read_header(const TokenReader::Line& line) {
    const std::string value = upper_case(line.value);
    if (line.key == "TYPE") return read_type(value);
    if (line.key == "DIMENSION") return read_count(line, dimension_, kMaxVertices);
    if (line.key == "GTSP_SETS") return read_count(line, sets_, kMaxVertices);
    if (line.key == "EDGE_WEIGHT_TYPE") {
      metric_ = metric_named(value);
      is_explicit_ = value == "EXPLICIT";
      if (metric_ || is_explicit_) return {};
      return reader_.error(line.key, line.value, "must be EUC_2D, CEIL_2D, GEO, GEOM, ATT or EXPLICIT");
    }
    if (line.key == "EDGE_WEIGHT_FORMAT") {
      format_ = MatrixFormat::named(value);
      if (format_ || value == "FUNCTION") return {};
      return reader_.error(line.key, line.value,
                           "must be FULL_MATRIX, a row or column triangle, or FUNCTION");
    }
    for (const std::string_view ignored : kIgnoredKeys) {
      if (line.key != ignored) continue;
      is_skipping_ = line.key.ends_with("_SECTION");
      return {};
    }
    return reader_.error(line.key, line.value, "is not a key of the format");
  }

  Status read_type(const std::string& value) {
    const std::string type = value.substr(0, value.find_first_of(" \t("));
    is_plain_ = type == "TSP" || type == "ATSP";
    if (is_plain_ || type == "GTSP" || type == "AGTSP") return {};
    return reader_.error("TYPE", value, "must be GTSP, AGTSP, TSP or ATSP");
  }

  Status read_count(const TokenReader::Line& line, int& count, int most) {
    const auto number = detail::parsed_int(line.value);
    if (!number || *number < 1 || *number > most) {
      return reader_.error(line.key, line.value, "must be an integer from 1 to " + std::to_string(most));
    }
    if (has_data_) return reader_.error(line.key, line.value, "must come before the sections");
    count = *number;
    return {};
  }

  /// A vertex or set number, from 0.
  Result<int> read_id(const std::string& key, int count) {
    const Result<int> id = reader_.next_int(key);
    if (!id) return id;
    if (*id < 1 || *id > count)
      return reader_.error(key, std::to_string(*id), "must be from 1 to " + std::to_string(count));
    return *id - 1;
  }

  Status begin_section(const std::string& key, bool is_repeated) {
    has_data_ = true;
    if (dimension_ == 0) return reader_.error(key, "begins", "DIMENSION must come before it");
    if (is_repeated) return reader_.error(key, "begins", "must appear once");
    return {};
  }

  Status read_points() {
    static const std::string kKey = "NODE_COORD_SECTION";
    if (Status s = begin_section(kKey, !points_.empty()); !s) return s;
    std::vector<char> is_given;
    for (int i = 0; i < dimension_; ++i) {
      const Result<int> id = read_id(kKey, dimension_);
      if (!id) return id.error();
      const auto v = static_cast<std::size_t>(*id);
      const Result<double> x = reader_.next_double(kKey);
      if (!x) return x.error();
      const Result<double> y = reader_.next_double(kKey);
      if (!y) return y.error();
      if (is_given.size() <= v) is_given.resize(v + 1, 0);
      if (points_.size() <= v) points_.resize(v + 1);
      if (!is_within(*x, -kMostCoordinate, kMostCoordinate) ||
          !is_within(*y, -kMostCoordinate, kMostCoordinate))
        return reader_.error(kKey, std::to_string(*id + 1), "coordinates must be finite, within 1e11");
      if (is_given[v] != 0) return reader_.error(kKey, std::to_string(*id + 1), "must appear once");
      is_given[v] = 1;
      points_[v] = {*x, *y};
    }
    return {};
  }

  Status read_weights() {
    static const std::string kKey = "EDGE_WEIGHT_SECTION";
    if (Status s = begin_section(kKey, !weights_.empty()); !s) return s;
    if (!format_) return reader_.error(kKey, "begins", "EDGE_WEIGHT_FORMAT must say how, before it");
    if (dimension_ > kMaxMatrixVertices) {
      return reader_.error(kKey, std::to_string(dimension_),
                           "a matrix may have at most " + std::to_string(kMaxMatrixVertices) + " rows");
    }
    for (int row = 0; row < dimension_; ++row) {
      for (int column = format_->first(row); column < format_->end(row, dimension_); ++column) {
        const Result<double> weight = reader_.next_double(kKey);
        if (!weight) return weight.error();
        const bool is_valid = row == column || (*weight >= 0.0 && *weight <= kMaxArcCost);
        if (!is_valid) return reader_.error(kKey, std::to_string(*weight), "must be from 0 to 1e12");
        weights_.push_back(*weight);
      }
    }
    return {};
  }

  Status read_sets() {
    static const std::string kKey = "GTSP_SET_SECTION";
    if (Status s = begin_section(kKey, !clusters_.empty()); !s) return s;
    if (sets_ == 0) return reader_.error(kKey, "begins", "GTSP_SETS must come before it");
    if (sets_ > dimension_)
      return reader_.error("GTSP_SETS", std::to_string(sets_), "must not be more than DIMENSION");
    for (int i = 0; i < sets_; ++i) {
      const Result<int> set = read_id(kKey, sets_);
      if (!set) return set.error();
      if (clusters_.size() <= static_cast<std::size_t>(*set))
        clusters_.resize(static_cast<std::size_t>(*set) + 1);
      auto& cluster = clusters_[static_cast<std::size_t>(*set)];
      if (!cluster.empty()) return reader_.error(kKey, std::to_string(*set + 1), "must appear once");
      if (Status s = read_members(kKey, *set, cluster); !s) return s;
    }
    set_of_.resize(static_cast<std::size_t>(dimension_), -1);
    for (std::size_t v = 0; v < set_of_.size(); ++v) {
      if (set_of_[v] < 0)
        return reader_.error(kKey, "end",
                             "vertex " + std::to_string(v + 1) + " is in no set; each must be in one");
    }
    return {};
  }

  Status read_members(const std::string& key, int set, std::vector<int>& cluster) {
    while (true) {
      const Result<int> id = reader_.next_int(key);
      if (!id) return id.error();
      if (*id == -1 && cluster.empty())
        return reader_.error(key, std::to_string(set + 1), "the set is empty; each must hold a vertex");
      if (*id == -1) return {};
      if (*id < 1 || *id > dimension_) {
        return reader_.error(key, std::to_string(*id),
                             "must be from 1 to " + std::to_string(dimension_) + ", or -1 to end the set");
      }
      if (set_of_.size() < static_cast<std::size_t>(*id)) set_of_.resize(static_cast<std::size_t>(*id), -1);
      int& owner = set_of_[static_cast<std::size_t>(*id) - 1];
      if (owner >= 0) {
        return reader_.error(key, std::to_string(*id),
                             "is also in set " + std::to_string(owner + 1) + "; it must be in exactly one");
      }
      owner = set;
      cluster.push_back(*id - 1);
    }
  }

  /// The full matrix, from the entries listed.
  std::vector<double> matrix() const {
    if (format_->shape == MatrixFormat::Shape::kFull) return weights_;
    const auto n = static_cast<std::size_t>(dimension_);
    std::vector<double> full(n * n, 0.0);
    std::size_t next = 0;
    for (int row = 0; row < dimension_; ++row) {
      for (int column = format_->first(row); column < format_->end(row, dimension_); ++column) {
        const double weight = weights_[next++];
        full[static_cast<std::size_t>(row) * n + static_cast<std::size_t>(column)] = weight;
        full[static_cast<std::size_t>(column) * n + static_cast<std::size_t>(row)] = weight;
      }
    }
    return full;
  }

  Result<Instance> assembled() {
    if (dimension_ == 0) return reader_.error("DIMENSION", "missing", "must be given");
    if (is_plain_ && clusters_.empty()) {
      for (int v = 0; v < dimension_; ++v) clusters_.push_back({v});
    }
    if (clusters_.empty()) return reader_.error("GTSP_SET_SECTION", "missing", "must be given");
    if (!metric_ && !is_explicit_) return reader_.error("EDGE_WEIGHT_TYPE", "missing", "must be given");
    if (metric_ && points_.empty())
      return reader_.error("NODE_COORD_SECTION", "missing", "must be given for this EDGE_WEIGHT_TYPE");
    const bool has_matrix = !weights_.empty() || (dimension_ == 1 && format_);
    if (is_explicit_ && !has_matrix)
      return reader_.error("EDGE_WEIGHT_SECTION", "missing", "must be given for EXPLICIT");
    Result<Instance> instance =
        metric_ ? Instance::from_points(std::move(clusters_), std::move(points_), *metric_)
                : Instance::from_matrix(dimension_, std::move(clusters_), matrix());
    if (!instance)
      return bad_input(reader_.error("GTSP_SET_SECTION", "sets", instance.error().message).message);
    return instance;
  }

  TokenReader reader_;
  int dimension_ = 0;
  int sets_ = 0;
  bool is_plain_ = false;
  bool is_explicit_ = false;
  bool is_skipping_ = false;
  bool has_data_ = false;
  std::optional<Metric> metric_;
  std::optional<MatrixFormat> format_;
  std::vector<Point> points_;
  std::vector<double> weights_;
  Instance::Clusters clusters_;
  std::vector<int> set_of_;  ///< by vertex, −1 = none yet
};

}  // namespace

Result<Instance> read_gtsplib(std::istream& in, const std::string& name) {
  return GtsplibReader(in, name).read();
}

Result<Instance> read_gtsplib(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) return not_found("The file " + path.string() + " cannot be opened.");
  return read_gtsplib(file, path.string());
}

}  // namespace swallowtail::gtsp
