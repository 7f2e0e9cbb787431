#include "coverage/gtsp/proof/certificate.hpp"

#include <algorithm>
#include <cmath>

#include "coverage/gtsp/proof/ascent.hpp"
#include "coverage/gtsp/proof/label_search.hpp"

namespace swallowtail::gtsp::proof {
namespace {

constexpr double kFirstGap = 0.002;  ///< relative, of the first guess above the bound
constexpr double kGapGrowth = 2.0;
constexpr int kGuesses = 8;               ///< before no tour is left out
constexpr double kWidestKnownGap = 0.02;  ///< of bound and known tour for which states are searched
constexpr int kSmallClusters = 24;        ///< up to so many they are always searched

class Certifier {
 public:
  Certifier(const Instance& instance, const detail::Anchor& anchor, const detail::Pruning& pruning,
            const CertificateParams& params, const StopCondition& stop)
      : params_(params),
        stop_(stop),
        graph_(instance, anchor, pruning),
        ascent_(graph_, params.upper_bound) {}

  Certificate run() {
    const double share = graph_.cluster_count() <= kSmallClusters ? 0.3 : 0.7;
    const WalkAscent::End end = ascent_.climb(share * params_.work, stop_);
    if (!settled(end)) {
      search_states();
      if (result_.kind == Certificate::Kind::kBound && end != WalkAscent::End::kStalled)
        settled(ascent_.climb(params_.work - ascent_.work() - search_work_, stop_));
    }
    if (result_.kind == Certificate::Kind::kBound) result_.lower_bound = bound();
    result_.rounding = graph_.is_integer() ? 0.0 : 2e-10 * result_.lower_bound;
    result_.work = ascent_.work() + search_work_;
    return std::move(result_);
  }

 private:
  double bound() const { return std::min(ascent_.rounded(ascent_.bound()), params_.upper_bound); }

  void take(const std::vector<int>& tour, double cost) {
    result_.kind = Certificate::Kind::kOptimal;
    result_.lower_bound = cost;
    for (const int v : tour) result_.order.push_back(graph_.original(v));
  }

  void prove() {
    const bool has_tour = params_.upper_bound != kNoArc;
    result_.kind = has_tour ? Certificate::Kind::kProved : Certificate::Kind::kNoTour;
    result_.lower_bound = params_.upper_bound;
  }

  bool settled(WalkAscent::End end) {
    if (end == WalkAscent::End::kTour) {
      take(ascent_.tour(), ascent_.rounded(ascent_.bound()));
      return true;
    }
    if (end != WalkAscent::End::kProved && end != WalkAscent::End::kNoWalk) return false;
    prove();
    return true;
  }

  /// Looks for tours up to the known one's cost, or without one up to ever more above the bound.
  void search_states() {
    if (graph_.cluster_count() > LabelSearch::kMaxClusters) return;
    const double known = params_.upper_bound;
    if (known != kNoArc) {
      const bool is_near = bound() >= (1.0 - kWidestKnownGap) * known;
      if (!is_near && graph_.cluster_count() > kSmallClusters) return;
      const double limit = graph_.is_integer() ? known - 1.0 + 1e-6 : known;
      if (search_up_to(limit) && result_.kind == Certificate::Kind::kBound) prove();
      return;
    }
    if (graph_.cluster_count() > kSmallClusters) return;
    double gap = std::max(kFirstGap * ascent_.bound(), graph_.is_integer() ? 1.0 : 1e-9);
    for (int guess = 0; guess < kGuesses; ++guess, gap *= kGapGrowth) {
      if (!search_up_to(ascent_.bound() + gap) || result_.kind != Certificate::Kind::kBound) return;
    }
    const double all = 2.0 * kMaxArcCost * graph_.cluster_count();
    if (search_up_to(all) && result_.kind == Certificate::Kind::kBound) prove();
  }

  /// Whether the search went through; with a tour, result_ is set.
  bool search_up_to(double limit) {
    const double left = params_.work - ascent_.work() - search_work_;
    if (left <= 0.0 || stop_.reached(0, 0)) return false;
    WalkGraph graph = graph_;
    WalkAscent narrowed = ascent_.on(graph);
    if (!narrowed.drop_arcs(limit, 400 * static_cast<std::size_t>(graph.size()))) return false;
    LabelSearch search(graph, narrowed.walks(), narrowed.price());
    const LabelSearch::Answer answer = search.run(limit, params_.max_states, left, stop_);
    search_work_ += search.work() + narrowed.work();
    if (answer.end != LabelSearch::End::kSearched) return false;
    if (!answer.tour.empty()) take(answer.tour, answer.cost);
    return true;
  }

  const CertificateParams& params_;
  const StopCondition& stop_;
  WalkGraph graph_;
  WalkAscent ascent_;
  Certificate result_;
  double search_work_ = 0.0;
};

}  // namespace

Certificate certify(const Instance& instance, const detail::Anchor& anchor, const detail::Pruning& pruning,
                    const CertificateParams& params, const StopCondition& stop) {
  return Certifier(instance, anchor, pruning, params, stop).run();
}

}  // namespace swallowtail::gtsp::proof
