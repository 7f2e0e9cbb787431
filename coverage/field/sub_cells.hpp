#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "coverage/field/polygon.hpp"
#include "coverage/field/strips.hpp"
#include "planner/base/vec.hpp"
#include "planner/world/terrain.hpp"

namespace swallowtail::coverage {

/// A field as asked for. `height_m` is the flying height above ground.
struct Field {
  std::uint32_t id = 0;
  std::string name;
  Polygon polygon;
  double height_m = 20.0;
};

/// A stretch that is flown straight at one altitude from one of its two sites to the other [COV 3].
struct SubCell {
  std::uint32_t id = 0;
  std::uint32_t field_id = 0;
  Vec3 alpha_m = Vec3::Zero();
  Vec3 beta_m = Vec3::Zero();
  double height_m = 0.0;  ///< above ground, as asked
  double width_m = 0.0;   ///< of the sensor's swath

  double length_m() const { return (beta_m - alpha_m).norm(); }
};

/// What becomes of a band along a field's border: of all that is nearer to it than headland_m.
enum class Headland : std::uint8_t { kNone, kSkip, kFly };

/// How fields are to be flown, besides sensor and heights.
struct FieldRules {
  double overlap = 0.0;  ///< share of the sensor's width that neighbouring strips see both
  Headland headland = Headland::kNone;
  double headland_m = 0.0;  ///< its width
  Beyond beyond = Beyond::kNever;
  double ceiling_m = std::numeric_limits<double>::infinity();  ///< greatest lawful height above ground
};
Status validate(const FieldRules& rules);

struct CutParams {
  double sensor_width_m = 10.0;
  std::optional<double> sweep_rad{};  ///< see StripParams
  double piece_cost_m = 25.0;         ///< see SweepParams
  TurnCost turn{};
  double height_tolerance_m =
      2.0;  ///< over terrain: a sub-cell is cut where the height above ground would leave this band
  double clearance_m = 2.5;  ///< least height above ground that is ever flown
  double max_length_m =
      std::numeric_limits<double>::infinity();  ///< what one battery flies, climb and landing left aside
  FieldRules rules;
  std::vector<Polygon> no_fly;  ///< neither covered nor crossed
};
Status validate(const CutParams& params);

enum class FieldStatus : std::uint8_t {
  kPlanned,  ///< at least kCoveredShare of its area is covered
  kPartly,   ///< flown, but less is covered: `reason` says how little and names the largest gap's place
  kRefused,
};

/// Of a field's area, at the least, for the field to count as covered.
inline constexpr double kCoveredShare = 0.999;

struct FieldCut {
  std::uint32_t id = 0;
  std::string name;
  FieldStatus status = FieldStatus::kRefused;
  std::string reason;  ///< why it was refused or is not wholly covered, a sentence with name and place
  std::vector<Polygon> polygons;  ///< cleaned, without no-fly areas: where lines and transfers may run
  double area_m2 = 0.0;           ///< asked for: without holes, no-fly areas and a headland that is skipped
  double covered_m2 = 0.0;        ///< of the field, by the union of the swaths
  double outside_m2 = 0.0;        ///< of the swaths' union, beyond the field
  double sweep_rad = 0.0;
  int strips = 0;
  int cells = 0;                   ///< connected parts of strips
  int beyond_tolerance = 0;        ///< sub-cells so steep that even the shortest leaves the height band
  std::vector<SubCell> sub_cells;  ///< along the strips, ids from 0
};

inline constexpr std::size_t kMaxSubCells = 16384;

/// Cleans the field, takes no-fly areas and a headland off, cuts the rest into strips and these into
/// sub-cells, and measures what they cover. It never fails: what no line inside sees leaves it kPartly, and a
/// field that cannot be planned comes back refused with the reason: not a valid polygon, wholly within no-fly
/// areas or headland, smaller across than the sensor's width, a height beyond the ceiling or below the
/// clearance, a battery that does not fly one sensor width.
FieldCut cut_field(const Field& field, const planner::Terrain& terrain, const CutParams& params);

}  // namespace swallowtail::coverage
