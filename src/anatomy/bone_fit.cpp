// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "anatomy/bone_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "anatomy/wrist_model.hpp"

namespace carpus::anatomy {
namespace {

constexpr int kIterations = 40;
constexpr double kHuberMm = 1.0;
/// Step of the numerical gradient; the model is smooth over millimetres.
constexpr double kProbeMm = 0.05;
/// Points this close to the model's cut are left out: its face is no bone surface.
constexpr double kCutMarginMm = 1.0;
constexpr ScaleRange kScaleRange{0.7, 1.4};
/// Levenberg damping relative to the diagonal: the shaft alone leaves sliding along it weak.
constexpr double kDamping = 1e-3;
constexpr double kConverged = 1e-6;  // of the step, in mm and rad
constexpr std::size_t kUnknowns = 7;
using Row = std::array<double, kUnknowns>;

struct NormalEquations {
  std::array<Row, kUnknowns> matrix{};
  Row right{};
  double squares = 0;
  std::size_t count = 0;
};

/// Solves the damped equations by Gaussian elimination with pivoting; empty if singular.
std::optional<Row> solve(NormalEquations e) {
  auto& a = e.matrix;
  for (std::size_t i = 0; i < kUnknowns; ++i) a[i][i] *= 1 + kDamping;
  for (std::size_t c = 0; c < kUnknowns; ++c) {
    std::size_t pivot = c;
    for (std::size_t r = c + 1; r < kUnknowns; ++r) {
      if (std::abs(a[r][c]) > std::abs(a[pivot][c])) pivot = r;
    }
    if (!(std::abs(a[pivot][c]) > 0)) return std::nullopt;
    std::swap(a[c], a[pivot]);
    std::swap(e.right[c], e.right[pivot]);
    for (std::size_t r = c + 1; r < kUnknowns; ++r) {
      const double f = a[r][c] / a[c][c];
      for (std::size_t k = c; k < kUnknowns; ++k) a[r][k] -= f * a[c][k];
      e.right[r] -= f * e.right[c];
    }
  }
  Row x{};
  for (std::size_t i = kUnknowns; i-- > 0;) {
    double sum = e.right[i];
    for (std::size_t k = i + 1; k < kUnknowns; ++k) sum -= a[i][k] * x[k];
    x[i] = sum / a[i][i];
  }
  return x;
}

/// Model coordinates of a patient point.
Vec3 model_from_patient(const Similarity& t, const Vec3& p) {
  return (t.rotation.transposed() * (p - t.translation)) / t.scale;
}

/// Unknowns: a small turn of the model point (3), a shift in model mm (3), relative growth (1):
/// m' = m + turn x m + shift + growth m.
NormalEquations linearise(const WristModel& model,
                          const ModelBone& bone,
                          std::span<const Vec3> border,
                          const Similarity& t) {
  NormalEquations e;
  for (const Vec3& p : border) {
    const Vec3 m = model_from_patient(t, p);
    if (bone.cut_plane && bone.cut_plane->signed_distance(m) > -kCutMarginMm) continue;
    const auto f = [&](const Vec3& q) { return model.uncut_value(bone.bone, q); };
    const double value = f(m);
    const Vec3 g{(f(m + Vec3{kProbeMm, 0, 0}) - f(m - Vec3{kProbeMm, 0, 0})) / (2 * kProbeMm),
                 (f(m + Vec3{0, kProbeMm, 0}) - f(m - Vec3{0, kProbeMm, 0})) / (2 * kProbeMm),
                 (f(m + Vec3{0, 0, kProbeMm}) - f(m - Vec3{0, 0, kProbeMm})) / (2 * kProbeMm)};
    const double steepness = length(g);
    if (!(steepness > 0.1) || !std::isfinite(value)) continue;  // deep inside, f is no distance
    const double r = value / steepness;
    const Vec3 n = g / steepness;
    const double weight = std::abs(r) <= kHuberMm ? 1.0 : kHuberMm / std::abs(r);
    const Vec3 turn = cross(m, n);
    const Row row{turn.x, turn.y, turn.z, n.x, n.y, n.z, dot(n, m)};
    for (std::size_t i = 0; i < kUnknowns; ++i) {
      for (std::size_t k = 0; k < kUnknowns; ++k) e.matrix[i][k] += weight * row[i] * row[k];
      e.right[i] -= weight * row[i] * r;
    }
    e.squares += weight * r * r;
    ++e.count;
  }
  return e;
}

/// The similarity whose model points are those of `t` moved by the step.
Similarity moved(const Similarity& t, const Row& step) {
  const Vec3 turn{step[0], step[1], step[2]};
  const double angle = length(turn);
  const Mat3 r = rotation_about(normalized_or(turn, {1, 0, 0}), angle);
  const Vec3 shift{step[3], step[4], step[5]};
  // m' = k r m + shift with m = R^T (p - t) / s, solved for p.
  Similarity next;
  next.rotation = t.rotation * r.transposed();
  next.scale = std::clamp(t.scale / (1 + step[6]), kScaleRange.low, kScaleRange.high);
  next.translation = t.translation - next.scale * (next.rotation * shift);
  return next;
}

}  // namespace

BoneFit fit_bone(BoneId bone, std::span<const Vec3> border, Side side, const Similarity& start) {
  const WristModel& model = WristModel::generic(side);
  BoneFit fit{start, 0, 0};
  for (int i = 0; i < kIterations; ++i) {
    const NormalEquations e = linearise(model, model.bone(bone), border, fit.patient_from_model);
    fit.points_used = e.count;
    fit.rms_mm = e.count > 0 ? fit.patient_from_model.scale *
                                   std::sqrt(e.squares / static_cast<double>(e.count))
                             : 0.0;
    if (e.count < kUnknowns) break;
    const std::optional<Row> step = solve(e);
    if (!step) break;
    fit.patient_from_model = moved(fit.patient_from_model, *step);
    double largest = 0;
    for (const double s : *step) largest = std::max(largest, std::abs(s));
    if (largest < kConverged) break;
  }
  return fit;
}

}  // namespace carpus::anatomy
