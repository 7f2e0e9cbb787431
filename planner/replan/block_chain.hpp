#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <vector>

#include "planner/base/vec.hpp"

namespace swallowtail::planner {

using Mat3 = Eigen::Matrix3d;

/// A symmetric block-tridiagonal system of 3 × 3 blocks: what the second derivatives of a chain of points
/// look like. Takes memory in `resize` only.
class BlockChain {
 public:
  void resize(std::size_t count) {
    diagonal.resize(count);
    beyond.resize(count);
    factor_.resize(count);
    coupling_.resize(count);
    partial_.resize(count);
  }
  std::size_t size() const { return diagonal.size(); }
  void set_zero() {
    for (Mat3& block : diagonal) block.setZero();
    for (Mat3& block : beyond) block.setZero();
  }

  /// Solves (this + damping·1) x = right by block Cholesky; false where it is not positive definite.
  bool solve(double damping, const std::vector<Vec3>& right, std::vector<Vec3>& x) {
    for (std::size_t i = 0; i < size(); ++i) {
      Mat3 pivot = diagonal[i];
      pivot.diagonal().array() += damping;
      partial_[i] = right[i];
      if (i > 0) {
        pivot.noalias() -= coupling_[i - 1].transpose() * coupling_[i - 1];
        partial_[i].noalias() -= coupling_[i - 1].transpose() * partial_[i - 1];
      }
      if (!cholesky(pivot, factor_[i])) return false;
      forward(factor_[i], partial_[i]);
      if (i + 1 == size()) continue;
      for (Eigen::Index c = 0; c < 3; ++c) {
        Vec3 column = beyond[i].col(c);
        forward(factor_[i], column);
        coupling_[i].col(c) = column;
      }
    }
    for (std::size_t i = size(); i-- > 0;) {
      x[i] = partial_[i];
      if (i + 1 < size()) x[i].noalias() -= coupling_[i] * x[i + 1];
      backward(factor_[i], x[i]);
    }
    return true;
  }

  std::vector<Mat3> diagonal;
  std::vector<Mat3> beyond;  ///< beyond[i] couples points i and i + 1; the last one counts for nothing

 private:
  /// Lower factor; its diagonal is kept inverted.
  static bool cholesky(const Mat3& a, Mat3& l) {
    const double scale = a.diagonal().cwiseAbs().maxCoeff();
    const double least = 1e-12 * scale;
    if (!(a(0, 0) > least)) return false;
    l(0, 0) = 1.0 / std::sqrt(a(0, 0));
    l(1, 0) = a(1, 0) * l(0, 0);
    l(2, 0) = a(2, 0) * l(0, 0);
    const double second = a(1, 1) - l(1, 0) * l(1, 0);
    if (!(second > least)) return false;
    l(1, 1) = 1.0 / std::sqrt(second);
    l(2, 1) = (a(2, 1) - l(2, 0) * l(1, 0)) * l(1, 1);
    const double third = a(2, 2) - l(2, 0) * l(2, 0) - l(2, 1) * l(2, 1);
    if (!(third > least)) return false;
    l(2, 2) = 1.0 / std::sqrt(third);
    return true;
  }
  static void forward(const Mat3& l, Vec3& v) {
    v[0] *= l(0, 0);
    v[1] = (v[1] - l(1, 0) * v[0]) * l(1, 1);
    v[2] = (v[2] - l(2, 0) * v[0] - l(2, 1) * v[1]) * l(2, 2);
  }
  static void backward(const Mat3& l, Vec3& v) {
    v[2] *= l(2, 2);
    v[1] = (v[1] - l(2, 1) * v[2]) * l(1, 1);
    v[0] = (v[0] - l(1, 0) * v[1] - l(2, 0) * v[2]) * l(0, 0);
  }

  std::vector<Mat3> factor_;
  std::vector<Mat3> coupling_;
  std::vector<Vec3> partial_;
};

}  // namespace swallowtail::planner
