// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <doctest/doctest.h>

#include <yoke/cases/choices/quantity.hpp>
#include <yoke/core/error.hpp>
#include <yoke/core/units.hpp>
#include <yoke/tests/messages.hpp>

namespace {

using namespace yoke::cases;
using namespace yoke::literals;

std::string refusal(Quantity quantity, std::string_view text) {
  return yoke::tests::message_of([&] { parse_quantity("name", quantity, text); });
}

TEST_SUITE("quantities") {
  TEST_CASE("numbers with units become SI, to the last bit") {
    CHECK(parse_quantity("x", Quantity::length, "45mm") == 0.045);
    CHECK(parse_quantity("x", Quantity::length, " 45 mm ") == 0.045);
    CHECK(parse_quantity("x", Quantity::length, "4.5cm") == 0.045);
    CHECK(parse_quantity("x", Quantity::length, "0.045m") == 0.045);
    CHECK(parse_quantity("x", Quantity::length, "-100um") == -1e-4);
    CHECK(parse_quantity("x", Quantity::angle, "-149deg") == doctest::Approx(-149.0_deg));
    CHECK(parse_quantity("x", Quantity::angle, "1.5rad") == 1.5);
    CHECK(parse_quantity("x", Quantity::time, "0s") == 0.0);
    CHECK(parse_quantity("x", Quantity::time, "20ms") == 0.02);
    CHECK(parse_quantity("x", Quantity::time_per_length, "0.32s/m") == 0.32);
    CHECK(parse_quantity("x", Quantity::time_per_length, "3.2e-4s/mm") == doctest::Approx(0.32));
    CHECK(parse_quantity("x", Quantity::number, "2") == 2.0);
  }

  TEST_CASE("a wrong quantity is explained") {
    CHECK(refusal(Quantity::length, "45") == "name: '45' has no unit; accepted: mm, cm, m, um");
    CHECK(refusal(Quantity::length, "45deg") ==
          "name: '45deg' has the unit 'deg'; accepted: mm, cm, m, um");
    CHECK(refusal(Quantity::number, "2s") ==
          "name: '2s' has the unit 's'; accepted: a plain number");
    CHECK(refusal(Quantity::length, "mm") == "name: 'mm' does not start with a finite number");
    CHECK(refusal(Quantity::length, "nanmm") ==
          "name: 'nanmm' does not start with a finite number");
    CHECK(refusal(Quantity::length, "1e999mm") ==
          "name: '1e999mm' does not start with a finite number");
    CHECK(refusal(Quantity::length, "") == "name: '' does not start with a finite number");
  }

  TEST_CASE("values are printed in the unit people draw in") {
    CHECK(format_quantity(Quantity::length, 0.045) == "45 mm");
    CHECK(format_quantity(Quantity::angle, -31.0_deg) == "-31 deg");
    CHECK(format_quantity(Quantity::number, 2.0) == "2");
  }

  TEST_CASE("the nearest known word is suggested") {
    const std::vector<std::string> known{"crank_length", "start_angle", "table11-johnson"};
    CHECK(nearest_word("crank_lenght", known) == "crank_length");
    CHECK(nearest_word("johnson", known) == "table11-johnson");
    CHECK(nearest_word("zzzzzzzz", known) == "");
    CHECK(suggestion("strat_angle", known).starts_with("; did you mean 'start_angle'? Known: '"));
    CHECK(suggestion("zzzzzzzz", known).starts_with("; known: 'crank_length', "));
  }
}

}  // namespace
