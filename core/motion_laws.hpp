// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Laws of motion as they are used for cams: rises from 0 to 1, and chains of them. A chain is a
// function of time for drivers, or a function of an angle for cams and grooves.
//
//   const MotionChain lift = motion({{cycloidal, 120.0_deg, 20.0_mm},
//                               {dwell, 60.0_deg},
//                               {polynomial_345, 120.0_deg, 0.0_mm},
//                               {dwell, 60.0_deg}}, {.repeat = Repeat::periodic});
//   lift(angle).value, lift(angle).first ...               [m], [m/rad] ...
//   DisplacementDriver{.displacement = motion({...})}      over seconds instead of degrees
//
// Peaks of velocity and acceleration of a rise 0 to 1 over 0 to 1, and where the acceleration
// jumps (Norton, Cam Design and Manufacturing Handbook; Neklutin's modified laws):
//
//   simple harmonic     1.5708   4.9348   at both ends
//   cycloidal           2        6.2832
//   modified sine       1.7596   5.5280
//   modified trapezoid  2        4.8881
//   polynomial 3-4-5    1.875    5.7735
//   polynomial 4-5-6-7  2.1875   7.5132   (nor does the third derivative jump)
#pragma once

#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include <yoke/core/time_function.hpp>

namespace yoke {

/// A function and its derivatives by its argument; the argument is a time [s] or an angle [rad].
struct MotionValue {
  double value = 0.0;   // the function
  double first = 0.0;   // by the argument
  double second = 0.0;  // twice
  double third = 0.0;   // thrice

  operator TimeValue() const { return {value, first, second}; }  // over a time
};

/// A rise from 0 to 1 while x goes from 0 to 1, with exact derivatives. A law of your own is a name
/// and a function: {"parabola", [](double x) { return MotionValue{...}; }}.
struct MotionLaw {
  std::string_view name;                  // for messages
  MotionValue (*at)(double x) = nullptr;  ///< for 0 <= x <= 1
};

extern const MotionLaw dwell;               ///< stays; the only one that does not rise
extern const MotionLaw constant_velocity;   ///< x; its velocity jumps unless laws beside it join it
extern const MotionLaw simple_harmonic;     ///< (1 - cos(pi x)) / 2
extern const MotionLaw cycloidal;           ///< x - sin(2 pi x) / (2 pi)
extern const MotionLaw modified_sine;       ///< Neklutin
extern const MotionLaw modified_trapezoid;  ///< Neklutin
extern const MotionLaw polynomial_345;      ///< 10 x^3 - 15 x^4 + 6 x^5
extern const MotionLaw polynomial_4567;     ///< 35 x^4 - 84 x^5 + 70 x^6 - 20 x^7
/// From rest to twice the mean velocity, x - sin(pi x) / pi: before constant_velocity.
extern const MotionLaw cycloidal_start;
/// The same backwards, x + sin(pi x) / pi: after constant_velocity.
extern const MotionLaw cycloidal_end;

/// All of the above.
const std::vector<MotionLaw>& motion_laws();

/// One law over an interval of the argument.
struct MotionSegment {
  MotionLaw law;               // how it gets there
  double over = 0.0;           // > 0, length of the interval [s] or [rad]
  std::optional<double> to{};  // value at its end; none for a dwell
};

/// What a motion does beyond its segments.
enum class Repeat {
  never,      // goes on at the velocity it has at its ends: rests if that is 0
  periodic,   // begins again; its values at both ends are the same
  advancing,  // begins again from where it is: an indexing drive
};

/// Where a chain of segments begins, and what it does beyond.
struct MotionOptions {
  double start = 0.0;             // value where the first segment begins
  double begin = 0.0;             // argument there
  Repeat repeat = Repeat::never;  // beyond the segments
};

/// A chain of segments; a value. Evaluation allocates nothing.
class MotionChain {
 public:
  /// Throws ModelError for a length that is not positive, values that do not join, and where the
  /// velocity jumps, naming the two segments and both velocities. The acceleration may jump.
  MotionChain(std::vector<MotionSegment> segments, MotionOptions options = {});

  /// Any argument. Where a derivative jumps it is the one to the right.
  MotionValue operator()(double x) const;

  /// Argument where the first segment begins.
  double begin() const { return ends_.front().argument; }
  /// Argument where the last one ends.
  double end() const { return ends_.back().argument; }
  /// end - begin, for a motion that repeats; infinite for one that does not.
  double period() const;

  /// Where segments begin, and the end of the last.
  std::vector<double> junctions() const;
  /// Whether the segment stays.
  bool dwells(std::size_t segment) const { return laws_[segment].at == dwell.at; }
  /// Of one segment, up to both of its ends, whatever comes before or after; as it is at the nearer
  /// end for x beyond them.
  MotionValue inside(std::size_t segment, double x) const;

 private:
  struct End {  // of a segment, and the beginning of the next
    double argument, value;
  };
  void add(const MotionSegment& segment);
  void check_velocities() const;

  std::vector<MotionLaw> laws_;
  std::vector<End> ends_;  // one more than laws
  Repeat repeat_;
};

/// The same, to be written where a driver is: .angle = motion({...}).
inline MotionChain motion(std::vector<MotionSegment> segments, MotionOptions options = {}) {
  return MotionChain(std::move(segments), options);
}

}  // namespace yoke
