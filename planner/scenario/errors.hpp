#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace swallowtail::planner {

/// One thing wrong with a scenario file.
struct ScenarioError {
  /// The first five are what the schema can say; the others only the reader knows.
  enum class Kind : std::uint8_t {
    kType,
    kUnknownKey,
    kMissingKey,
    kNotFinite,
    kRange,
    kSyntax,
    kRelation,
    kDuplicate,
    kFile
  };

  Kind kind = Kind::kSyntax;
  std::string file;
  int line =
      0;  ///< 1-based; of the value, or of the map that misses a key; 0 when the file could not be read
  std::string key;    ///< from the top: obstacles[2].radius_m
  std::string value;  ///< as written, shortened
  std::string rule;   ///< what it must be

  /// `file:line: key: value: rule`
  std::string text() const;
};

const char* name(ScenarioError::Kind kind);

/// Everything wrong with a file, in the order of its lines. Never empty where it stands for a failure.
struct ScenarioErrors {
  std::vector<ScenarioError> errors;
  /// One line for each.
  std::string text() const;
};

}  // namespace swallowtail::planner
