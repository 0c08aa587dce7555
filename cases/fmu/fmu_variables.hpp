// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What an FMU is of, and the variables it shows. The value reference of a variable is its place in the
// list.
//   fixed     numeric parameters of the case, "case.crank_length", in SI units: before the start only
//   tunable   changeable parameters of elements, "spring.stiffness": at any time
//   input     loads and speeds of drivers, "motor.speed": held during a step
//   output    the columns of the samples, "crank.angle_rad"
#pragma once

#include <limits>
#include <string>
#include <vector>

#include <yoke/cases/case.hpp>

namespace yoke::cases {

/// What was exported; a file in the FMU.
struct FmuDescription {
  std::string case_name;
  std::vector<std::string> settings;  // "crank_length=50mm"
  std::string law;                    // "": the case's own
  double relative_tolerance = 1e-8;
  std::string guid;  // of what the variables depend on

  std::string to_json() const;
  /// Throws ModelError for text that is no description.
  static FmuDescription from_json(const std::string& text);
};

enum class FmuRole { fixed, tunable, input, output };

struct FmuVariable {
  std::string name, unit{}, description{};
  FmuRole role = FmuRole::output;
  double start = 0.0;  // of all but outputs, SI
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  std::size_t index = 0;  // of the changeable parameter or of the column
  std::string case_parameter{};
};

/// The mechanism of a description with the case's parameters as given. Throws ModelError.
Model fmu_model(const FmuDescription& description, const Parameters& parameters);
/// The parameters of the case with the settings of the description. Throws ModelError.
Parameters fmu_parameters(const FmuDescription& description);
/// The variables of the FMU. Throws ModelError.
std::vector<FmuVariable> fmu_variables(const FmuDescription& description);
/// [s] How long the case lasts.
double fmu_duration(const FmuDescription& description, const Parameters& parameters);

/// modelDescription.xml.
std::string model_description(const FmuDescription& description);

}  // namespace yoke::cases
