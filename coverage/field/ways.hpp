#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "coverage/field/polygon.hpp"

namespace swallowtail::coverage {

/// The polygons' holes, but those that one of the fields lies in.
std::vector<Polygon> holes_without_fields(std::span<const Polygon> polygons, std::span<const Polygon> fields);

/// Holes that fields lie in, without filling them.
std::vector<Polygon> holes_around_fields(std::span<const Polygon> polygons, std::span<const Polygon> fields);

/// Shortest ways in the plane that leave holes and no-fly areas aside. Between two places of one field the
/// way stays inside that field where it can; between others, and where a field is too narrow for a way, it
/// may cross open ground, but no hole and no no-fly area: a hole around a field only where the way begins or
/// ends in such a hole. On a border that fields share a place is on all of them. Visibility graph over the
/// corners that a taut string can bend at, pushed 2 cm off the border (where there are more than 1600, over
/// fewer of them as long as there is a way past these: then it may be longer than need be); what is found is
/// kept. Not for use by several threads at once. From a place inside a hole or no-fly area the way leads
/// straight out of it first.
class Ways {
 public:
  Ways();  ///< nothing is in the way
  /// Clean polygons; holes of `fields` and all of `no_fly` are what is not crossed, and `around` are holes
  /// around fields besides those of `fields`.
  Ways(std::span<const Polygon> fields, std::span<const Polygon> no_fly,
       std::span<const Polygon> around = {});
  ~Ways();
  Ways(Ways&&) noexcept;
  Ways& operator=(Ways&&) noexcept;

  /// Where the way bends, in order; empty when it is straight. Nothing when there is no way: holes and no-fly
  /// areas cut the two off from each other.
  std::optional<std::vector<Vec2>> corners(const Vec2& from, const Vec2& to) const;
  bool is_free(const Vec2& from, const Vec2& to) const;

 private:
  class Domain;
  struct Whereabouts {
    std::vector<std::size_t> rooms;  ///< the fields; on a common border more than one
    bool is_nested = false;          ///< in a hole around a field
  };
  const Whereabouts& whereabouts(const Vec2& place) const;
  std::vector<Domain*> common_rooms(const Vec2& from, const Vec2& to) const;
  Domain* open_ground(const Vec2& from, const Vec2& to) const;
  std::optional<std::vector<Vec2>> find(const Vec2& from, const Vec2& to) const;

  std::vector<Polygon> fields_;
  std::vector<Polygon> around_;
  std::vector<std::unique_ptr<Domain>> rooms_;  ///< one per field
  std::unique_ptr<Domain> open_;                ///< what lies outside no-fly areas and holes without fields
  std::unique_ptr<Domain> outer_;  ///< and outside holes around fields; none where there are none
  using Place = std::pair<double, double>;
  mutable std::map<Place, Whereabouts> whereabouts_;
  /// The way asked for last: it is asked for again at once, in all the ways of flying it.
  struct Bent {
    Vec2 from_m = Vec2::Zero();
    Vec2 to_m = Vec2::Zero();
    std::optional<std::vector<Vec2>> corners_m;
  };
  mutable std::optional<Bent> last_;
};

}  // namespace swallowtail::coverage
