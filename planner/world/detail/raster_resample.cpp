#include <fmt/format.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "planner/base/checks.hpp"
#include "planner/world/detail/projection.hpp"
#include "planner/world/detail/raster_source.hpp"

namespace swallowtail::planner::detail {
namespace {

constexpr double kMaxDistance_m = 3e5;
/// Steps of a grid that is meant to fit a length exactly may miss it by this share of a cell.
constexpr double kCellSlack = 1e-4;

Error resample_error(const std::string& path, const std::string& what) {
  return bad_input(fmt::format("The raster '{}' {}.", path, what));
}

/// A rectangle in the local frame, and the cell size that keeps the file's resolution.
struct Frame {
  Vec2 min_m = Vec2::Constant(std::numeric_limits<double>::infinity());
  Vec2 max_m = Vec2::Constant(-std::numeric_limits<double>::infinity());
  double cell_size_m = 0.0;
};

/// Sample centres around the file's outline.
std::vector<Vec2> outline(const RasterSource& source) {
  std::vector<Vec2> places;
  for (int c = 0; c < source.cols; ++c) {
    places.push_back(source.transform.place(c + 0.5, 0.5));
    places.push_back(source.transform.place(c + 0.5, source.rows - 0.5));
  }
  for (int r = 0; r < source.rows; ++r) {
    places.push_back(source.transform.place(0.5, r + 0.5));
    places.push_back(source.transform.place(source.cols - 0.5, r + 0.5));
  }
  return places;
}

bool convert(OGRCoordinateTransformation& transform, std::vector<Vec2>& places) {
  return std::all_of(places.begin(), places.end(),
                     [&](Vec2& p) { return transform.Transform(1, &p.x(), &p.y()) != 0 && is_finite(p); });
}

Result<Frame> measure(const std::string& path, const RasterSource& source,
                      OGRCoordinateTransformation& to_local_frame) {
  std::vector<Vec2> places = outline(source);
  const double c = 0.5 * (source.cols - 1);
  const double r = 0.5 * (source.rows - 1);
  std::vector<Vec2> middle = {source.transform.place(c, r), source.transform.place(c + 1.0, r),
                              source.transform.place(c, r + 1.0)};
  if (!convert(to_local_frame, places) || !convert(to_local_frame, middle)) {
    return resample_error(path, "cannot be projected around the origin: " + last_gdal_message());
  }
  Frame frame;
  for (const Vec2& p : places) {
    frame.min_m = frame.min_m.cwiseMin(p);
    frame.max_m = frame.max_m.cwiseMax(p);
  }
  frame.cell_size_m = std::min((middle[1] - middle[0]).norm(), (middle[2] - middle[0]).norm());
  const double distance = std::max(frame.min_m.cwiseAbs().maxCoeff(), frame.max_m.cwiseAbs().maxCoeff());
  if (!(distance <= kMaxDistance_m)) {
    return resample_error(
        path, fmt::format("reaches {:.0f} km from the origin; at most {:.0f} km are allowed", distance / 1e3,
                          kMaxDistance_m / 1e3));
  }
  if (!is_positive(frame.cell_size_m)) return resample_error(path, "has cells without a size");
  return frame;
}

/// So many steps of the cell size that they reach, or nearly reach, the whole width.
double cells_over(double width_m, double cell_size_m) {
  return std::max(1.0, std::ceil(width_m / cell_size_m - kCellSlack));
}

}  // namespace

Result<TerrainGrid> as_local(const std::string& path, const RasterSource& source, const GeoOrigin& origin,
                             double max_samples) {
  if (!source.reference)
    return resample_error(path, "names no coordinate system, so that it cannot be placed around an origin");
  auto local = local_frame(origin);
  if (!local) return local.error();
  auto to_local_frame = make_transform(*source.reference, *local);
  if (!to_local_frame) return to_local_frame.error();
  auto to_file = make_transform(*local, *source.reference);
  if (!to_file) return to_file.error();
  const auto frame = measure(path, source, **to_local_frame);
  if (!frame) return frame.error();

  const double cols = cells_over(frame->max_m.x() - frame->min_m.x(), frame->cell_size_m) + 1.0;
  const double rows = cells_over(frame->max_m.y() - frame->min_m.y(), frame->cell_size_m) + 1.0;
  if (!(cols * rows <= max_samples)) {
    return resample_error(
        path, fmt::format("would need {:.0f} samples around the origin; at most {:.0f} are allowed",
                          cols * rows, max_samples));
  }
  TerrainGrid grid{frame->min_m, frame->cell_size_m, static_cast<int>(rows), static_cast<int>(cols), {}};
  grid.elevation_m.reserve(static_cast<std::size_t>(grid.rows) * static_cast<std::size_t>(grid.cols));
  std::vector<double> x(static_cast<std::size_t>(grid.cols));
  std::vector<double> y(x.size());
  for (int r = 0; r < grid.rows; ++r) {
    for (std::size_t c = 0; c < x.size(); ++c) {
      x[c] = grid.origin_m.x() + static_cast<double>(c) * grid.cell_size_m;
      y[c] = grid.origin_m.y() + r * grid.cell_size_m;
    }
    if ((*to_file)->Transform(grid.cols, x.data(), y.data()) == 0)
      return resample_error(path, "cannot be projected: " + last_gdal_message());
    for (std::size_t c = 0; c < x.size(); ++c) {
      const Vec2 pixel = source.transform.pixel(Vec2(x[c], y[c])).array() - 0.5;
      if (!is_finite(pixel)) return resample_error(path, "cannot be projected around the origin everywhere");
      grid.elevation_m.push_back(static_cast<float>(source.at(pixel.x(), pixel.y()) - origin.elevation_m));
    }
  }
  return grid;
}

}  // namespace swallowtail::planner::detail
