// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/contact/geometry/region_chain.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <yoke/core/curves/bend_range.hpp>

namespace yoke {

namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();
constexpr double end_slack = 1e-9;  // share of a piece that is its end
constexpr int curvature_samples = 400;

}  // namespace

RegionChain::RegionChain(Curve curve, double distance, std::vector<double> signs)
    : curve_(std::move(curve)), distance_(distance), signs_(std::move(signs)) {
  const std::size_t count = curve_.pieces();
  const bool ring = curve_.closed() && count > 1;
  for (std::size_t i = 0; i < count; ++i)
    for (const double sign : signs_) {
      Side side{.piece = i, .sign = sign, .high = curve_.piece(i).end()};
      if (i > 0 || ring) side.before = side_region((i + count - 1) % count, sign);
      if (i + 1 < count || ring) side.after = side_region((i + 1) % count, sign);
      sides_.push_back(side);
    }
}

int RegionChain::side_region(std::size_t piece, double sign) const {
  std::size_t place = 0;
  while (place + 1 < signs_.size() && sign * signs_[place] < 0.0) ++place;
  return static_cast<int>(piece * signs_.size() + place);
}

int RegionChain::add(const Round& round) {
  rounds_.push_back(round);
  return static_cast<int>(sides_.size() + rounds_.size()) - 1;
}

void RegionChain::link(int side, bool at_end, int region) {
  Side& wall = sides_[static_cast<std::size_t>(side)];
  (at_end ? wall.after : wall.before) = region;
}

double RegionChain::curvature_of_wall(const Round& round) const {
  if (round.kind != SlotRegion::edge) return -1.0 / distance_;
  return round.edge_radius > 0.0 ? 1.0 / round.edge_radius : unbounded;
}

/// The mean is taken over the length of the wall: what it turns by, divided by its length.
std::vector<CurvatureRange> RegionChain::curvatures() const {
  std::vector<CurvatureRange> ranges;
  for (const Side& side : sides_) {
    const CurvePiece& piece = curve_.piece(side.piece);
    const BendRange bends = bend_range(piece, side.low, side.high);
    const double one = curvature_of_wall(side.sign * bends.low),
                 other = curvature_of_wall(side.sign * bends.high);
    CurvatureRange range{std::min(one, other), std::max(one, other)};
    double turn = 0.0, length = 0.0;
    for (int i = 0; i <= curvature_samples; ++i) {
      const CurvePoint at = piece.at(side.low + (side.high - side.low) * i / curvature_samples);
      const double k = side.sign * at.curvature;
      const double weight = (i % curvature_samples == 0 ? 0.5 : 1.0) * at.speed;
      turn += weight * k;
      length += weight * (1.0 - k * distance_);
    }
    range.mean = turn / length;
    ranges.push_back(range);
  }
  for (const Round& round : rounds_) {
    const double curvature = curvature_of_wall(round);
    ranges.push_back({curvature, curvature, curvature});
  }
  return ranges;
}

Touch RegionChain::touch(int region, const Vec2& p) const {
  if (is_side(region)) {
    const Side& side = side_of(region);
    const CurveOffset offset = curve_.piece(side.piece).offset(p);
    const double s = side.sign;
    return {region,
            s * offset.distance,
            s * offset.normal,
            s * offset.bend(),
            curvature_of_wall(s * offset.curvature),
            offset.u};
  }
  const Round& round = round_of(region);
  const Vec2 from = p - round.center;
  const double distance = from.norm();
  const Vec2 away = distance > 0.0 ? Vec2(from / distance) : Vec2(1.0, 0.0);
  const double bend = distance > 0.0 ? 1.0 / distance : 0.0;
  if (round.kind == SlotRegion::edge)
    return {region, distance_ + round.edge_radius - distance, -away, -bend,
            curvature_of_wall(round)};
  return {region, distance, away, bend, curvature_of_wall(round)};
}

bool RegionChain::follows(int region) const {
  return !is_side(region) || curve_.piece(side_of(region).piece).curvature_change(0.0).has_value();
}

/// The foot of p moves by dl = t.dp/(1 - k D_c) along the curve. So with k the curvature towards the
/// wall, f(k) that of the wall, x = 1/(1 - k D), and ' = d/dl:
///   gradient  f' x t       Hessian  f'' x^2 t t^T + f' [k_c x^2 (n t^T + t n^T) + k_c' D_c x^3 t t^T]
CurvatureField RegionChain::curvature_field(const Touch& touch) const {
  if (!is_side(touch.region)) return {};
  const Side& side = side_of(touch.region);
  const CurvePiece& piece = curve_.piece(side.piece);
  const auto change = piece.curvature_change(touch.u);
  if (!change || (change->first == 0.0 && change->second == 0.0)) return {};
  const double s = side.sign, h = distance_;
  const double k = touch.wall_curvature / (1.0 + touch.wall_curvature * h);
  const double k1 = s * change->first, k2 = s * change->second;
  const double y = 1.0 / (1.0 - k * h), x = 1.0 / (1.0 - k * touch.distance);
  const double f1 = y * y * k1, f2 = y * y * k2 + 2.0 * h * y * y * y * k1 * k1;
  return {.along = -s * f1 * x,
          .tt = f2 * x * x + f1 * k1 * touch.distance * x * x * x,
          .tn = -s * f1 * k * x * x};
}

double RegionChain::boundary(int region, const Vec2& p) const {
  const auto [before, after] = beyond(region, p);
  return std::max(before, after);
}

int RegionChain::successor(int region, const Vec2& p) const {
  const auto [before, after] = beyond(region, p);
  const bool back = before >= after;
  if (is_side(region)) return back ? side_of(region).before : side_of(region).after;
  const Round& round = round_of(region);
  const int next = back ? round.before : round.after;
  if (round.kind == SlotRegion::edge || round.kind == SlotRegion::corner) return next;
  // A cap ends at both walls.
  const std::size_t piece = side_of(next).piece;
  return side_region(piece, curve_.piece(piece).offset(p).distance >= 0.0 ? 1.0 : -1.0);
}

/// [m] how far p is beyond the beginning and the end of a region; -infinity where it has none.
std::pair<double, double> RegionChain::beyond(int region, const Vec2& p) const {
  double before = -unbounded, after = -unbounded;
  if (is_side(region)) {
    const Side& side = side_of(region);
    if (side.before == none && side.after == none) return {-1.0, -1.0};
    const CurvePiece& piece = curve_.piece(side.piece);
    const double u = piece.foot(p);
    if (side.before != none) before = (side.low - u) * piece.at(side.low).speed;
    if (side.after != none) after = (u - side.high) * piece.at(side.high).speed;
    return {before, after};
  }
  const Round& round = round_of(region);
  const Vec2 from = p - round.center;
  if (round.before != none) before = -from.dot(round.t_begin);
  if (round.after != none) after = from.dot(round.t_end);
  return {before, after};
}

/// Behind an end or a corner the foot is the end of the piece, and p is not across from it. The range
/// of a round region alone does not tell: of a curve that turns far, it holds points that are close to
/// other parts.
int RegionChain::region_at(int side, double u, const Vec2& p) const {
  const Side& here = side_of(side);
  const double slack = end_slack * curve_.piece(here.piece).end();
  const auto behind = [&](int next) { return !is_side(next) && boundary(next, p) < 0.0; };
  if (here.before != none && (u < here.low || (u <= here.low + slack && behind(here.before))))
    return here.before;
  if (here.after != none && (u > here.high || (u >= here.high - slack && behind(here.after))))
    return here.after;
  return side;
}

}  // namespace yoke
