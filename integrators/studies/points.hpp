// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The points of a study: a place in the box of its axes each. Grids, samples of the box, lists. Points
// have an order, and what they are depends on nothing but what is said here: the same call gives the same
// bits anywhere.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <yoke/core/result.hpp>

namespace yoke {

/// One thing that varies: a number between two ends, one of a list of numbers, or one of a list of words.
struct StudyAxis {
  std::string name;                  // "clearance"; none twice in a study
  std::string unit{};                // of the numbers, as "m/s^2"; "": none
  std::vector<double> values{};      // that a grid takes, in its order
  std::vector<std::string> words{};  // if not empty, values are indices into these
  bool range = false;            // samples lie between low and high; else they are among the values
  double low = 0.0, high = 0.0;  // [unit] ends of a range
  bool logarithmic = false;      // a range is divided evenly in its logarithm
  bool whole = false;            // samples of a range are whole numbers
};

/// `count` numbers evenly from low to high, both ends included; interior ones are rounded to 15 digits, so
/// that 0.1 is 0.1. Throws ModelError naming the axis if count < 1, an end is not finite, or one value is to
/// reach from one end to another.
StudyAxis linear_axis(std::string name, double low, double high, std::size_t count,
                      std::string unit = "");
/// The same evenly in the logarithm, rounded to 13 digits; also throws ModelError unless both ends are > 0.
StudyAxis log_axis(std::string name, double low, double high, std::size_t count,
                   std::string unit = "");
/// Numbers one by one. Throws ModelError if there is none, or one is not finite.
StudyAxis value_axis(std::string name, std::vector<double> values, std::string unit = "");
/// A choice of words. Throws ModelError if there is none.
StudyAxis word_axis(std::string name, std::vector<std::string> words);

/// Points in their order, each with a coordinate on every axis.
class StudyPoints {
 public:
  /// No points and no axes.
  StudyPoints() = default;
  /// `coordinates` point after point. `origin` says for people how they were chosen. Throws ModelError if
  /// two axes have one name, or numbers and axes do not fit, or a coordinate of words is none of them.
  StudyPoints(std::vector<StudyAxis> axes, std::vector<double> coordinates, std::string origin);

  /// How many points there are.
  std::size_t size() const { return size_; }
  /// In the order of the coordinates.
  const std::vector<StudyAxis>& axes() const { return axes_; }
  /// "grid of 50 x 3", "100 random points, seed 1".
  const std::string& origin() const { return origin_; }
  /// One number; of an axis of words an index. Without a check.
  double coordinate(std::size_t point, std::size_t axis) const {
    return coordinates_[point * axes_.size() + axis];
  }
  /// The coordinate as text: the word, or the number with the fewest digits that bring back every bit.
  std::string text(std::size_t point, std::size_t axis) const;
  /// Number of an axis. Throws ModelError that lists the axes.
  std::size_t axis(std::string_view name) const;

 private:
  std::vector<StudyAxis> axes_;
  std::vector<double> coordinates_;
  std::string origin_;
  std::size_t size_ = 0;
};

/// The largest number of points of one study.
inline constexpr std::size_t most_study_points = 100'000'000;

/// Every value of each axis with every value of the others; the last axis varies fastest. Throws
/// ModelError for more than most_study_points.
StudyPoints grid_points(std::vector<StudyAxis> axes);

/// `count` points, independent and uniform in the box (in the logarithm of logarithmic axes). A seed makes
/// the same points everywhere. Throws ModelError as grid_points.
StudyPoints random_points(std::vector<StudyAxis> axes, std::size_t count, std::uint64_t seed);

/// The first `count` points of Sobol's sequence, which fill the box evenly: the first points of a longer one
/// are those of a shorter one. Best in powers of two. Directions of Joe and Kuo, from Boost.Random.
StudyPoints sobol_points(std::vector<StudyAxis> axes, std::size_t count);

/// Points one by one: a row of coordinates each.
StudyPoints listed_points(std::vector<StudyAxis> axes,
                          const std::vector<std::vector<double>>& rows);

/// One point, as the function of a study sees it. Valid while the points are.
class StudyPoint {
 public:
  /// Point `index` of `points`.
  StudyPoint(const StudyPoints& points, std::size_t index) : points_(&points), index_(index) {}
  /// Its place in the order, from 0.
  std::size_t index() const { return index_; }
  /// The coordinate on the axis of that name. Throws ModelError that lists the axes.
  double operator[](std::string_view axis) const {
    return points_->coordinate(index_, points_->axis(axis));
  }
  /// The coordinate as text, as StudyPoints::text.
  std::string text(std::string_view axis) const {
    return points_->text(index_, points_->axis(axis));
  }

 private:
  const StudyPoints* points_;
  std::size_t index_;
};

}  // namespace yoke
