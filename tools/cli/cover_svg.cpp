#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/core.h>

#include "tools/cli/cover_files.hpp"

namespace swallowtail::cli {
namespace {

constexpr double kWidth = 900.0;
constexpr double kMapHeight = 620.0;
constexpr double kChartHeight = 150.0;
constexpr double kMargin = 40.0;
constexpr double kPanelHeight = kMapHeight + kChartHeight + 4.0 * kMargin;
/// Legs are numbered at steps so that no more than so many numbers stand in a picture.
constexpr std::size_t kMaxNumbers = 60;

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (static_cast<unsigned char>(c) >= 0x20) {
      out += c;
    }
  }
  return out;
}

struct TransferStyle {
  coverage::Transfer type;
  const char* stroke;
  const char* dash;
};
constexpr TransferStyle kTransferStyles[] = {{coverage::Transfer::kFF, "#555555", ""},
                                             {coverage::Transfer::kFFDU, "#1f77b4", "6 3"},
                                             {coverage::Transfer::kFDUF, "#9467bd", "6 3"},
                                             {coverage::Transfer::kFDUFDU, "#d62728", "2 2"},
                                             {coverage::Transfer::kFDTU, "#ff7f0e", "10 3 2 3"}};

const TransferStyle& style_of(coverage::Transfer type) {
  for (const TransferStyle& style : kTransferStyles) {
    if (style.type == type) return style;
  }
  return kTransferStyles[0];
}

/// From blue for the lowest to red for the highest.
std::string height_colour(double share) {
  return fmt::format("hsl({:.0f},75%,42%)", 220.0 * (1.0 - std::clamp(share, 0.0, 1.0)));
}

/// One task's panel, its top at `top`.
class Panel {
 public:
  Panel(const Covered& one, const std::string& title, double top)
      : plan_(*one.plan), task_(*one.task), top_(top) {
    fit();
    text_ += fmt::format("<text x=\"{}\" y=\"{}\" class=\"title\">{}</text>\n", kMargin, top_ + 24.0,
                         escaped(title));
    add_ground();
    add_legs();
    add_meetings();
    add_legend();
    add_battery();
  }
  const std::string& text() const { return text_; }

 private:
  void fit();
  void add_ground();
  void add_legs();
  void add_meetings();
  void add_legend();
  void add_battery();
  double x(const Vec3& p) const { return kMargin + (p.x() - lo_.x()) * scale_; }
  double y(const Vec3& p) const { return top_ + kMargin + kMapHeight - (p.y() - lo_.y()) * scale_; }
  std::string path(const coverage::Polygon& area) const;
  std::string polyline(const std::vector<Vec3>& points) const {
    std::string out;
    for (const Vec3& p : points) out += fmt::format("{:.1f},{:.1f} ", x(p), y(p));
    return out;
  }

  const coverage::Plan& plan_;
  const coverage::Task& task_;
  double top_;
  Vec2 lo_ = Vec2::Zero();
  double scale_ = 1.0;
  double lowest_m_ = 0.0;
  double highest_m_ = 0.0;
  std::string text_;
};

void Panel::fit() {
  Vec2 lo = Vec2::Constant(std::numeric_limits<double>::infinity());
  Vec2 hi = -lo;
  const auto take = [&](const Vec2& p) {
    lo = lo.cwiseMin(p);
    hi = hi.cwiseMax(p);
  };
  for (const auto& field : task_.fields) {
    for (const Vec2& p : field.polygon.outline) take(p);
  }
  lowest_m_ = std::numeric_limits<double>::infinity();
  highest_m_ = -lowest_m_;
  for (const auto& leg : plan_.legs) {
    take(leg.entry_m.head<2>());
    take(leg.exit_m.head<2>());
    for (const Vec3& p : leg.transfer_m) take(p.head<2>());
    lowest_m_ = std::min(lowest_m_, leg.height_m);
    highest_m_ = std::max(highest_m_, leg.height_m);
  }
  take(task_.start_m.head<2>());
  lo_ = lo;
  const Vec2 extent = (hi - lo).cwiseMax(1.0);
  scale_ = std::min((kWidth - 2.0 * kMargin - 150.0) / extent.x(), kMapHeight / extent.y());
}

std::string Panel::path(const coverage::Polygon& area) const {
  std::string out;
  const auto add = [&](const coverage::Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec3 p(ring[i].x(), ring[i].y(), 0.0);
      out += fmt::format("{}{:.1f} {:.1f}", i == 0 ? "M" : "L", x(p), y(p));
    }
    if (!ring.empty()) out += "Z";
  };
  add(area.outline);
  for (const auto& hole : area.holes) add(hole);
  return out;
}

void Panel::add_ground() {
  for (const auto& field : task_.fields)
    text_ += fmt::format("<path d=\"{}\" class=\"field\"/>\n", path(field.polygon));
  for (const auto& area : task_.no_fly)
    text_ += fmt::format("<path d=\"{}\" class=\"nofly\"/>\n", path(area));
}

void Panel::add_legs() {
  const double range = highest_m_ - lowest_m_;
  const std::size_t step = std::max<std::size_t>(1, plan_.legs.size() / kMaxNumbers + 1);
  for (std::size_t i = 0; i < plan_.legs.size(); ++i) {
    const coverage::Leg& leg = plan_.legs[i];
    if (i + 1 < plan_.legs.size()) {
      const TransferStyle& style = style_of(leg.transfer);
      text_ += fmt::format(
          "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1\" "
          "stroke-dasharray=\"{}\"/>\n",
          polyline(transfer_after(plan_, i)), style.stroke, style.dash);
    }
    const double share = range > 0.0 ? (leg.height_m - lowest_m_) / range : 0.0;
    text_ += fmt::format(
        "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2.2\" "
        "marker-end=\"url(#tip)\"/>\n",
        polyline({leg.entry_m, leg.exit_m}), height_colour(share));
    if (i % step == 0) {
      text_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"number\">{}</text>\n", x(leg.entry_m),
                           y(leg.entry_m) - 2.0, i + 1);
    }
  }
}

void Panel::add_meetings() {
  text_ += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"8\" height=\"8\" class=\"start\"/>\n",
                       x(task_.start_m) - 4.0, y(task_.start_m) - 4.0);
  for (const auto& meeting : plan_.rendezvous) {
    text_ += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"5\" class=\"meeting\"/>\n",
                         x(meeting.site_m), y(meeting.site_m));
  }
}

void Panel::add_legend() {
  const double left = kWidth - 150.0;
  double row = top_ + kMargin + 10.0;
  const auto label = [&](const std::string& text) {
    text_ += fmt::format("<text x=\"{}\" y=\"{}\" class=\"label\">{}</text>\n", left + 40.0, row + 4.0, text);
    row += 18.0;
  };
  const auto line = [&](const std::string& stroke, const char* dash, double width) {
    text_ += fmt::format(
        "<line x1=\"{0}\" y1=\"{1}\" x2=\"{2}\" y2=\"{1}\" stroke=\"{3}\" stroke-width=\"{4}\" "
        "stroke-dasharray=\"{5}\"/>\n",
        left, row, left + 32.0, stroke, width, dash);
  };
  line(height_colour(0.0), "", 2.2);
  label(fmt::format("{:.0f} m above ground", lowest_m_));
  if (highest_m_ > lowest_m_) {
    line(height_colour(1.0), "", 2.2);
    label(fmt::format("{:.0f} m above ground", highest_m_));
  }
  for (const TransferStyle& style : kTransferStyles) {
    const bool used = std::any_of(plan_.legs.begin(), plan_.legs.end(),
                                  [&](const coverage::Leg& leg) { return leg.transfer == style.type; });
    if (!used) continue;
    line(style.stroke, style.dash, 1.5);
    label(coverage::name_of(style.type));
  }
  text_ += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"5\" class=\"meeting\"/>\n", left + 16.0, row);
  label("rendezvous");
  text_ += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"8\" height=\"8\" class=\"start\"/>\n", left + 12.0,
                       row - 4.0);
  label("start");
}

void Panel::add_battery() {
  const double bottom = top_ + kPanelHeight - kMargin;
  const double width = kWidth - 2.0 * kMargin;
  const double last_s = std::max(plan_.makespan_s, 1e-9);
  std::vector<std::pair<double, double>> points;
  for (const auto& leg : plan_.legs) {
    points.emplace_back(leg.start_s, leg.energy_before);
    points.emplace_back(leg.end_s, leg.energy_after);
  }
  for (const auto& meeting : plan_.rendezvous) {
    points.emplace_back(meeting.land_s, meeting.energy_from);
    points.emplace_back(meeting.depart_s, meeting.charge_to);
  }
  std::stable_sort(points.begin(), points.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  const auto at_x = [&](double s) { return kMargin + width * s / last_s; };
  const auto at_y = [&](double e) { return bottom - kChartHeight * e / task_.battery.capacity; };
  std::string line;
  for (const auto& [s, e] : points) line += fmt::format("{:.1f},{:.1f} ", at_x(s), at_y(e));
  text_ += fmt::format(
      "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" class=\"chart\"/>\n<polyline points=\"{}\" "
      "class=\"battery\"/>\n",
      kMargin, bottom - kChartHeight, width, kChartHeight, line);
  const double reserve = at_y(task_.battery.reserve);
  text_ += fmt::format("<line x1=\"{}\" y1=\"{:.1f}\" x2=\"{}\" y2=\"{:.1f}\" class=\"reserve\"/>\n", kMargin,
                       reserve, kMargin + width, reserve);
  text_ += fmt::format(
      "<text x=\"{}\" y=\"{}\" class=\"label\">energy, of {:.0f}; red: reserve</text>\n<text x=\"{}\" "
      "y=\"{}\" "
      "class=\"label\" text-anchor=\"end\">{:.0f} s</text>\n",
      kMargin, bottom - kChartHeight - 6.0, task_.battery.capacity, kMargin + width, bottom + 16.0, last_s);
}

constexpr const char* kHead =
    "<style>text{font-family:sans-serif;fill:#222}.title{font-size:16px;font-weight:bold}.label{font-size:"
    "11px}"
    ".number{font-size:8px;fill:#444}.field{fill:#e9f2e0;stroke:#4c7a34;fill-rule:evenodd}"
    ".nofly{fill:#f5c6c6;stroke:#b03030}.meeting{fill:none;stroke:#ff7f0e;stroke-width:2}.start{fill:#222}"
    ".chart{fill:#fafafa;stroke:#aaa}.battery{fill:none;stroke:#1f77b4;stroke-width:1.5}"
    ".reserve{stroke:#d62728;stroke-dasharray:4 3}</style>\n"
    "<defs><marker id=\"tip\" viewBox=\"0 0 6 6\" refX=\"6\" refY=\"3\" markerWidth=\"4\" markerHeight=\"4\" "
    "orient=\"auto\"><path d=\"M0 0L6 3L0 6z\"/></marker></defs>\n"
    "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";

std::string title_of(const CoverJob& job, const Covered& one) {
  const coverage::Plan& plan = *one.plan;
  const std::string name = one.task->fields.size() == 1 ? one.task->fields.front().name : job.name;
  const std::string whose = one.aircraft > 0 ? fmt::format(", aircraft {}", one.aircraft) : "";
  return fmt::format("{}{}: {:.2f} % covered, {:.0f} s, {} recharges", name, whose, plan.covered_percent,
                     plan.makespan_s, plan.recharges);
}

}  // namespace

std::string cover_svg(const CoverJob& job, const std::vector<Covered>& done) {
  std::string panels;
  double top = 0.0;
  std::size_t drawn = 0;
  std::string left_out;
  for (const Covered& one : done) {
    if (one.plan && drawn < kMaxPictures) {
      panels += Panel(one, title_of(job, one), top).text();
      top += kPanelHeight;
      ++drawn;
      continue;
    }
    for (const auto& field : one.task->fields) {
      left_out += fmt::format("<text x=\"{}\" y=\"{}\" class=\"label\">{}: {}</text>\n", kMargin, top + 20.0,
                              escaped(field.name), escaped(one.plan ? "planned, not drawn" : one.reason));
      top += 16.0;
    }
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}\" "
      "height=\"{}\">\n{}{}{}</svg>\n",
      kWidth, top + kMargin, kHead, panels, left_out);
}

}  // namespace swallowtail::cli
