#include "coverage/field/widen.hpp"

#include <string>

#include "coverage/field/detail/geos.hpp"

namespace swallowtail::coverage {

Result<std::vector<Polygon>> widened(std::span<const Polygon> areas, double by_m) {
  std::vector<Polygon> valid;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    const Result<std::vector<Polygon>> parts = clean(areas[i]);
    if (!parts) return Error{parts.error().code, "Area " + std::to_string(i) + ": " + parts.error().message};
    valid.insert(valid.end(), parts->begin(), parts->end());
  }
  std::vector<Polygon> out;
  if (valid.empty()) return out;
  const detail::Shape wide = detail::Shape::of(valid).inset(-by_m);
  if (!wide.ok()) return internal_error("The areas cannot be widened.");
  for (const Polygon& part : wide.parts()) {
    const Result<std::vector<Polygon>> parts = clean(part);
    if (!parts) return parts.error();
    out.insert(out.end(), parts->begin(), parts->end());
  }
  return out;
}

}  // namespace swallowtail::coverage
