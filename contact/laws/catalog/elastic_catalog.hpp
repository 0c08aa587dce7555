// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The elastic laws of cylinders by name, each in the readings that exist of it.
//
//   consistent  dimensionally and physically right; the derivation is in the law's own header
//   printed     Table 1 and the Nomenclature of Machines 2022, 10, 966 to the letter, in newton and
//               millimetre where they are dimensionally wrong
//   tabulated   what Tables 2 to 9 and 11 of the same paper were made with
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <yoke/contact/laws/catalog/power_fit.hpp>
#include <yoke/contact/laws/law.hpp>
#include <yoke/contact/laws/material.hpp>
#include <yoke/contact/laws/reading.hpp>

namespace yoke {

/// What the laws are made from, in SI units.
struct ElasticArguments {
  Material pin = steel, wall = steel;            // materials
  double pin_radius = 0.0;                       // [m], > 0
  double wall_radius = 0.0;                      // [m], > 0; internal: greater than pin_radius
  Conformity conformity = Conformity::internal;  // whether the wall is a bore
  double length = 0.0;                           // [m] of the line of contact, > 0
  Reading reading = Reading::consistent;         // of the published formula
};

/// What a law is made from: a name, its unit and the range accepted, as text.
struct LawParameter {
  std::string name, unit, range;  // as text
};

/// Description of a law.
struct ElasticNote {
  /// name as make_elastic() takes it; authors and year; the rest as in its source
  std::string name, title, formula, source, validity;
  std::vector<std::string> caveats;      // a sentence each
  std::vector<LawParameter> parameters;  // that enter the law
  std::vector<Reading> readings;         // that exist of it
};

/// hertz, lankarani-nikravesh, radzimovsky, goldsmith, dubowsky-freudenstein, esdu-78035, johnson,
/// pereira-2011, pereira-2015, power.
const std::vector<ElasticNote>& elastic_catalog();

/// Throws ModelError that lists the names.
const ElasticNote& find_elastic(std::string_view name);

/// `specification`: a name of the catalog, or a power law with its constants, "power:K=1e8,n=1.5"
/// (K in N/m^n) or "power:K=4.907e4,n=1.10,unit=mm" (K in N/mm^n), which takes nothing from the
/// arguments. Throws ModelError, also if the law does not exist in that reading.
ElasticLaw make_elastic(std::string_view specification, const ElasticArguments& arguments);

/// Known problems of a reading of a law; "" if none.
std::string elastic_warning(std::string_view name, Reading reading);

}  // namespace yoke
