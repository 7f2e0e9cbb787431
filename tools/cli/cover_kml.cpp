#include <fmt/core.h>

#include "tools/cli/cover_files.hpp"

namespace swallowtail::cli {
namespace {

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      default:
        if (static_cast<unsigned char>(c) >= 0x20) out += c;
    }
  }
  return out;
}

class KmlWriter {
 public:
  explicit KmlWriter(const planner::GeoOrigin& origin) : origin_(origin) {}

  void add(const std::string& name, const char* style, const std::string& description,
           const std::string& geometry) {
    text_ += fmt::format(
        "<Placemark><name>{}</name><styleUrl>#{}</styleUrl><description>{}</description>{}</Placemark>\n",
        escaped(name), style, escaped(description), geometry);
  }
  std::string line(const std::vector<Vec3>& points) const {
    std::string out = "<LineString><altitudeMode>absolute</altitudeMode><coordinates>";
    for (const Vec3& p : points) out += coordinates(p, p.z());
    return out + "</coordinates></LineString>";
  }
  std::string point(const Vec3& p) const {
    return "<Point><coordinates>" + coordinates(p, p.z()) + "</coordinates></Point>";
  }
  std::string polygon(const coverage::Polygon& area) const {
    std::string out = "<Polygon><outerBoundaryIs>" + ring(area.outline) + "</outerBoundaryIs>";
    for (const coverage::Ring& hole : area.holes)
      out += "<innerBoundaryIs>" + ring(hole) + "</innerBoundaryIs>";
    return out + "</Polygon>";
  }
  const std::string& text() const { return text_; }

 private:
  std::string coordinates(const Vec3& p, double z) const {
    const auto place = planner::to_geodetic(origin_, p.head<2>());
    if (!place) return "";
    return fmt::format("{:.9f},{:.9f},{:.3f} ", place->y(), place->x(), z + origin_.elevation_m);
  }
  std::string ring(const coverage::Ring& vertices) const {
    std::string out = "<LinearRing><coordinates>";
    for (std::size_t i = 0; i <= vertices.size() && !vertices.empty(); ++i) {
      const Vec2& p = vertices[i % vertices.size()];
      out += coordinates(Vec3(p.x(), p.y(), 0.0), 0.0);
    }
    return out + "</coordinates></LinearRing>";
  }

  planner::GeoOrigin origin_;
  std::string text_;
};

std::string folder(const Covered& one, std::size_t number) {
  KmlWriter kml(*one.task->origin);
  for (const coverage::Field& field : one.task->fields)
    kml.add(field.name, "field", "field", kml.polygon(field.polygon));
  for (const coverage::Polygon& area : one.task->no_fly)
    kml.add("no-fly area", "nofly", "neither covered nor crossed", kml.polygon(area));
  const coverage::Plan& plan = *one.plan;
  if (!plan.legs.empty())
    kml.add("approach", "transfer", "from the start to the first leg", kml.line(approach_of(one)));
  for (std::size_t i = 0; i < plan.legs.size(); ++i) {
    const coverage::Leg& leg = plan.legs[i];
    kml.add(fmt::format("leg {}", i), "leg",
            fmt::format("{} m above ground, {:.1f} s to {:.1f} s, energy {:.1f} to {:.1f}, then {}",
                        leg.height_m, leg.start_s, leg.end_s, leg.energy_before, leg.energy_after,
                        coverage::name_of(leg.transfer)),
            kml.line({leg.entry_m, leg.exit_m}));
    if (i + 1 == plan.legs.size()) continue;
    kml.add(fmt::format("transfer {}", i), leg.transfer == coverage::Transfer::kFDTU ? "carried" : "transfer",
            coverage::name_of(leg.transfer), kml.line(transfer_after(plan, i)));
  }
  for (const coverage::Rendezvous& meeting : plan.rendezvous) {
    kml.add(fmt::format("rendezvous {}", meeting.id), "rendezvous",
            fmt::format("landed {:.1f} s, off {:.1f} s, charged from {:.1f} to {:.1f}", meeting.land_s,
                        meeting.depart_s, meeting.energy_from, meeting.charge_to),
            kml.point(meeting.site_m));
  }
  const std::string name = one.aircraft > 0 ? fmt::format("task {}, aircraft {}", number, one.aircraft)
                                            : fmt::format("task {}", number);
  return fmt::format("<Folder><name>{}</name>\n{}</Folder>\n", name, kml.text());
}

}  // namespace

std::string cover_kml(const std::vector<Covered>& done) {
  std::string out =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<kml xmlns=\"http://www.opengis.net/kml/2.2\"><Document>\n"
      "<Style id=\"field\"><LineStyle><color>ff3c8c3c</color></LineStyle><PolyStyle><color>303c8c3c</color>"
      "</PolyStyle></Style>\n"
      "<Style id=\"nofly\"><LineStyle><color>ff2020c0</color></LineStyle><PolyStyle><color>602020c0</color>"
      "</PolyStyle></Style>\n"
      "<Style id=\"leg\"><LineStyle><color>ffc06010</color><width>3</width></LineStyle></Style>\n"
      "<Style id=\"transfer\"><LineStyle><color>ff808080</color><width>1</width></LineStyle></Style>\n"
      "<Style id=\"carried\"><LineStyle><color>ff0080ff</color><width>2</width></LineStyle></Style>\n"
      "<Style id=\"rendezvous\"><IconStyle><color>ff0080ff</color></IconStyle></Style>\n";
  std::size_t task = 0;
  for (std::size_t i = 0; i < done.size(); ++i) {
    if (i > 0 && done[i].aircraft <= 1) ++task;
    if (done[i].plan && done[i].task->origin) out += folder(done[i], task);
  }
  return out + "</Document></kml>\n";
}

}  // namespace swallowtail::cli
