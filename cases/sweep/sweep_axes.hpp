// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What a user varies, and how: NAME=LOW:HIGH:N, NAME=LOW:HIGH:N:log, NAME=A,B,C. NAME is a parameter of the
// case, `law` or `friction`, an option of the run (`rtol`, `formulation`, `spectral-radius`), or a word in braces
// in the text of the law or the friction, as in --law 'hertz+flores:e={e}'. A case with a parameter that is called
// `law` has its contact laws under `contact-law`.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <yoke/cases/case.hpp>
#include <yoke/integrators/studies/points.hpp>

namespace yoke::cases {

/// Which points, as typed.
struct SweepChoice {
  std::vector<std::string> vary{};  // NAME=...
  bool logarithmic = false;         // all ranges without a word of their own
  std::size_t random = 0;           // points; 0: not so
  std::size_t sobol = 0;            // points; 0: not so
  std::string list{};               // a CSV file; "": not so
  std::uint64_t seed = 1;           // of the random points
  std::string law{}, friction{};    // of all points, where words in braces may be
};

/// What is set at one point, as the command line takes it. "" and empty: as for all points.
struct SweepSetting {
  std::vector<std::string> parameters{};  // NAME=VALUE
  std::string law{}, friction{}, rtol{}, formulation{}, spectral_radius{};
};

/// What an axis sets.
enum class SweepTarget { parameter, law, friction, rtol, formulation, spectral_radius, word };

/// The points of a sweep: in SI for the table, and as a user types them.
class SweepPoints {
 public:
  /// Throws ModelError that names option, value and what is accepted; every value of every axis is checked
  /// against the range of its parameter.
  SweepPoints(const Case& c, const SweepChoice& choice);

  const StudyPoints& points() const { return points_; }
  SweepSetting setting(std::size_t point) const;
  /// "0.1mm", "johnson".
  std::string text(std::size_t point, std::size_t axis) const;
  /// The unit in which an axis was typed: "mm".
  const std::string& unit(std::size_t axis) const { return axes_[axis].unit; }

 private:
  struct Axis {
    std::string name{};
    SweepTarget target = SweepTarget::parameter;
    Quantity quantity = Quantity::number;
    std::string unit{};  // of the numbers that are typed; "": none, or words
    bool numeric = true;
    bool whole = false;
  };
  Axis target_of(const Case& c, const SweepChoice& choice, const std::string& name) const;
  StudyAxis parse(const Case& c, const SweepChoice& choice, const std::string& vary);
  StudyAxis parse_range(const std::vector<std::string>& parts, const SweepChoice& choice,
                        Axis& axis) const;
  StudyAxis parse_list(const std::vector<std::string>& texts, Axis& axis) const;
  void read_list(const Case& c, const SweepChoice& choice);
  void check_values(const Case& c, const std::vector<StudyAxis>& typed) const;
  double si(std::size_t axis, double typed) const;
  static std::string typed_text(const Axis& axis, double typed);

  std::vector<Axis> axes_;
  StudyPoints typed_, points_;
  std::string law_, friction_;  // of all points
};

}  // namespace yoke::cases
