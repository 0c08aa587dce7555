// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <doctest/doctest.h>

#include <string>

#include <yoke/contact/laws/catalog/dissipative_catalog.hpp>
#include <yoke/contact/laws/catalog/elastic_catalog.hpp>
#include <yoke/contact/laws/catalog/friction_catalog.hpp>
#include <yoke/tests/documentation.hpp>

namespace {

/// Whether a page names a law, as `name` or, within a formula, \\texttt{name}.
bool names(const std::string& page, const std::string& law) {
  return yoke::tests::contains(page, "`" + law) || yoke::tests::contains(page, "\\texttt{" + law);
}

}  // namespace

TEST_CASE("docs/theory/ says where every law of the catalogues comes from") {
  using namespace yoke;
  const std::string elastic = tests::source("docs/theory/elastic_laws.md"),
                    dissipative = tests::source("docs/theory/dissipative_laws.md"),
                    friction = tests::source("docs/theory/friction_laws.md");
  for (const ElasticNote& note : elastic_catalog())
    CHECK_MESSAGE(names(elastic, note.name), note.name);
  for (const DissipativeNote& note : dissipative_catalog())
    if (note.name != "none") CHECK_MESSAGE(names(dissipative, note.name), note.name);
  for (const FrictionNote& note : friction_catalog())
    CHECK_MESSAGE(names(friction, note.name), note.name);
}
