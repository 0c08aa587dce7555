// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/core/curves/curve.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include <yoke/core/error.hpp>

namespace yoke {

namespace {

constexpr double smallest_turn = 1e-9;  // [rad] of a corner
constexpr double largest_gap = 1e-9;    // in a chain, of its length

/// Turn from one unit vector to another [rad].
double turn_between(const Vec2& from, const Vec2& to) {
  return std::atan2(cross(from, to), from.dot(to));
}

/// Do the segments ab and cd have a point in common? Their boxes must, which alone tells segments
/// apart that lie on one line: the sides below are rounding then.
bool segments_cross(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  if ((a.cwiseMax(b).array() < c.cwiseMin(d).array()).any() ||
      (c.cwiseMax(d).array() < a.cwiseMin(b).array()).any())
    return false;
  const double c_side = cross(b - a, c - a), d_side = cross(b - a, d - a);
  const double a_side = cross(d - c, a - c), b_side = cross(d - c, b - c);
  return c_side * d_side <= 0.0 && a_side * b_side <= 0.0 &&
         (c_side != d_side || a_side != b_side);  // on one line: apart, as pieces go forward
}

}  // namespace

Curve::Curve(std::shared_ptr<const CurvePiece> piece, const Vec2& origin)
    : pieces_{std::move(piece)}, origin_(origin) {
  measure();
}

Curve::Curve(const Curve&) = default;
Curve::Curve(Curve&&) noexcept = default;
Curve& Curve::operator=(const Curve&) = default;
Curve& Curve::operator=(Curve&&) noexcept = default;
Curve::~Curve() = default;

void Curve::measure() {
  starts_.clear();
  length_ = 0.0;
  for (const auto& piece : pieces_) {
    starts_.push_back(length_);
    length_ += piece->length_to(piece->end());
  }
  closed_ = pieces_.size() == 1 && pieces_.front()->closed();
}

CurvePoint Curve::at(double s) const {
  const auto next = std::upper_bound(starts_.begin() + 1, starts_.end(), s);
  const std::size_t i = static_cast<std::size_t>(next - starts_.begin()) - 1;
  CurvePoint there = pieces_[i]->at(pieces_[i]->at_length(s - starts_[i]));
  there.point += origin_;
  return there;
}

double Curve::length_to(const CurvePlace& place) const {
  return starts_[place.piece] + pieces_[place.piece]->length_to(place.u);
}

CurvePlace Curve::nearest_local(const Vec2& p) const {
  if (pieces_.size() == 1)
    return {0, std::clamp(pieces_.front()->foot(p), 0.0, pieces_.front()->end())};
  CurvePlace best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const CurvePiece& piece = *pieces_[i];
    const double u = std::clamp(piece.foot(p), 0.0, piece.end());
    const double distance = (piece.at(u).point - p).squaredNorm();
    if (distance < least) least = distance, best = {i, u};
  }
  return best;
}

CurveOffset Curve::offset(const Vec2& p) const {
  const Vec2 local = p - origin_;
  return pieces_[nearest_local(local).piece]->offset(local);
}

Curve Curve::moved(double angle, const Vec2& shift) const {
  Curve result = *this;
  for (auto& piece : result.pieces_) piece = piece->moved(angle, Vec2(0.0, 0.0));
  result.origin_ = rotate(angle, origin_) + shift;
  return result;
}

std::vector<Vec2> Curve::sample(double spacing) const {
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const CurvePiece& piece = *pieces_[i];
    const double length = piece.length_to(piece.end());
    const int parts = std::max(1, static_cast<int>(std::ceil(length / spacing)));
    for (int k = i == 0 ? 0 : 1; k <= parts; ++k)
      points.push_back(piece.at(piece.at_length(length * k / parts)).point + origin_);
  }
  return points;
}

Curve chain(const std::vector<Curve>& curves) {
  if (curves.empty()) throw ModelError("chain: at least one curve is needed");
  Curve whole = curves.front();
  for (std::size_t i = 1; i < curves.size(); ++i)
    for (const auto& piece : curves[i].pieces_)
      whole.pieces_.push_back(piece->moved(0.0, curves[i].origin_ - whole.origin_));
  whole.measure();
  if (whole.pieces_.size() == 1) return whole;
  if (!std::isfinite(whole.length_))
    throw ModelError("chain: a line without ends cannot be part of it");
  const auto gap = [&](std::size_t from, std::size_t to) {
    const CurvePiece &a = *whole.pieces_[from], &b = *whole.pieces_[to];
    return (b.at(0.0).point - a.at(a.end()).point).norm();
  };
  const double allowed = largest_gap * whole.length_;
  for (std::size_t i = 0; i < whole.pieces_.size(); ++i) {
    if (whole.pieces_[i]->closed())
      throw ModelError(fmt::format("chain: curve {} is closed and cannot be part of it", i + 1));
    if (i > 0 && !(gap(i - 1, i) <= allowed))
      throw ModelError(
          fmt::format("chain: piece {} begins {:g} m from the end of piece {}; at most {:g} m",
                      i + 1, gap(i - 1, i), i, allowed));
  }
  whole.closed_ = gap(whole.pieces_.size() - 1, 0) <= allowed;
  return whole;
}

std::vector<CurveCorner> corners_of(const Curve& curve) {
  std::vector<CurveCorner> corners;
  const std::size_t count = curve.pieces();
  if (count < 2) return corners;
  for (std::size_t i = 0; i < (curve.closed() ? count : count - 1); ++i) {
    const CurvePiece &a = curve.piece(i), &b = curve.piece((i + 1) % count);
    const double turn = turn_between(a.at(a.end()).tangent, b.at(0.0).tangent);
    if (std::abs(turn) > smallest_turn) corners.push_back({i, turn});
  }
  return corners;
}

namespace {

/// Appends the points behind u0 up to u1 of a piece, with chords short and nearly straight.
void append_chords(const CurvePiece& piece, double u0, double u1, double longest, int splits,
                   std::vector<Vec2>& points) {
  const CurvePoint from = piece.at(u0), to = piece.at(u1), middle = piece.at(0.5 * (u0 + u1));
  constexpr double largest_turn = 0.25;  // [rad] along half a chord
  const bool straight =
      std::abs(turn_between(from.tangent, middle.tangent)) < largest_turn &&
      std::abs(turn_between(middle.tangent, to.tangent)) < largest_turn &&
      (middle.point - from.point).norm() + (to.point - middle.point).norm() < longest;
  if (straight || splits == 0) {
    points.push_back(to.point);
    return;
  }
  append_chords(piece, u0, 0.5 * (u0 + u1), longest, splits - 1, points);
  append_chords(piece, 0.5 * (u0 + u1), u1, longest, splits - 1, points);
}

}  // namespace

void require_simple(std::string_view owner, const Curve& curve) {
  if (!std::isfinite(curve.length())) return;
  constexpr int parts = 512, most_splits = 14;
  std::vector<Vec2> points{curve.piece(0).at(0.0).point};
  for (std::size_t i = 0; i < curve.pieces(); ++i)
    append_chords(curve.piece(i), 0.0, curve.piece(i).end(), curve.length() / parts, most_splits,
                  points);
  const std::size_t sides = points.size() - 1;
  for (std::size_t i = 0; i < sides; ++i)
    for (std::size_t j = i + 2; j < sides; ++j) {
      if (curve.closed() && i == 0 && j == sides - 1) continue;  // neighbours too
      if (segments_cross(points[i], points[i + 1], points[j], points[j + 1]))
        throw ModelError(fmt::format("{}: the curve crosses itself near ({:g}, {:g})", owner,
                                     points[i].x() + curve.origin().x(),
                                     points[i].y() + curve.origin().y()));
    }
}

}  // namespace yoke
