// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/contact/laws/catalog/dissipative_catalog.hpp>

#include <fmt/format.h>

#include <algorithm>

#include <yoke/contact/laws/dissipative/carvalho_martins.hpp>
#include <yoke/contact/laws/dissipative/exact_restitution.hpp>
#include <yoke/contact/laws/dissipative/flores.hpp>
#include <yoke/contact/laws/dissipative/gharib_hurmuzlu.hpp>
#include <yoke/contact/laws/dissipative/gharib_hurmuzlu_2.hpp>
#include <yoke/contact/laws/dissipative/gonthier.hpp>
#include <yoke/contact/laws/dissipative/herbert_mcwhannell.hpp>
#include <yoke/contact/laws/dissipative/hu_guo.hpp>
#include <yoke/contact/laws/dissipative/hunt_crossley.hpp>
#include <yoke/contact/laws/dissipative/kelvin_voigt.hpp>
#include <yoke/contact/laws/dissipative/khulief_shabana.hpp>
#include <yoke/contact/laws/dissipative/lankarani_nikravesh_1990.hpp>
#include <yoke/contact/laws/dissipative/lankarani_nikravesh_1994.hpp>
#include <yoke/contact/laws/dissipative/lee_wang_1.hpp>
#include <yoke/contact/laws/dissipative/lee_wang_2.hpp>
#include <yoke/contact/laws/dissipative/marhefka_orin.hpp>
#include <yoke/contact/laws/dissipative/marhefka_orin_simplified.hpp>
#include <yoke/contact/laws/dissipative/tsuji.hpp>
#include <yoke/contact/laws/dissipative/zhang_sharf.hpp>
#include <yoke/core/error.hpp>

namespace yoke {

namespace {

using Arguments = DissipativeArguments;

struct DissipativeEntry {
  DissipativeNote note;
  DissipativeLaw (*make)(const Arguments&);
  std::optional<double> (*delivers)(const Arguments&, double n, double approach_velocity);
};

// ---- how each law is made

DissipativeLaw make_none(const Arguments&) { return {}; }

template <class Law>
DissipativeLaw proportional(const Arguments& a) {
  return Law{a.restitution, a.slowest_approach};
}
template <class Law>
DissipativeLaw simple(const Arguments& a) {
  return Law{a.restitution};
}
template <class Law>
DissipativeLaw tensile(const Arguments& a) {
  return Law{a.restitution, a.tensile};
}
DissipativeLaw make_kelvin_voigt(const Arguments& a) { return tensile<KelvinVoigt>(a); }
DissipativeLaw make_hunt_crossley(const Arguments& a) {
  if (a.alpha) return HuntCrossley{*a.alpha};
  return hunt_crossley_restitution(a.restitution, a.slowest_approach);
}
DissipativeLaw make_herbert_mcwhannell(const Arguments& a) {
  if (a.empirical) return HerbertMcWhannellEmpirical{a.slowest_approach};
  return proportional<HerbertMcWhannell>(a);
}
DissipativeLaw make_lee_wang_2(const Arguments& a) {
  return LeeWang2{a.restitution, a.q, a.epsilon, a.tensile, a.slowest_approach};
}

// ---- what each law delivers

/// X of the law at `v_i`, less below the floor.
double delivered_with(double X, double v_i, double floor) {
  return restitution_of_damping(v_i < floor ? X * v_i / floor : X);
}

template <class Law>
std::optional<double> proportional_delivers(const Arguments& a, double, double v_i) {
  return delivered_with(Law{a.restitution, a.slowest_approach}.damping(), v_i, a.slowest_approach);
}
std::optional<double> hunt_crossley_delivers(const Arguments& a, double, double v_i) {
  if (a.alpha) return restitution_of_damping(1.5 * *a.alpha * v_i);
  return delivered_with(1.5 * (1.0 - a.restitution), v_i, a.slowest_approach);
}
std::optional<double> herbert_mcwhannell_delivers(const Arguments& a, double n, double v_i) {
  if (!a.empirical) return proportional_delivers<HerbertMcWhannell>(a, n, v_i);
  const double e = empirical_restitution(std::max(v_i, a.slowest_approach));
  return delivered_with(HerbertMcWhannell{e}.damping(), v_i, a.slowest_approach);
}
std::optional<double> ratio_delivers(const Arguments& a, double, double) {
  return restitution_of_ratio(damping_ratio(a.restitution), a.tensile);
}
std::optional<double> kelvin_voigt_delivers(const Arguments& a, double n, double v_i) {
  if (n != 1.0) return std::nullopt;
  return ratio_delivers(a, n, v_i);
}
std::optional<double> delivers_asked(const Arguments& a, double, double) { return a.restitution; }
std::optional<double> delivers_all(const Arguments&, double, double) { return 1.0; }
std::optional<double> no_closed_form(const Arguments&, double, double) { return std::nullopt; }

// ---- the table

constexpr const char* free_of_tension =
    "at zero penetration, without tension in a free impact; pulled apart faster than v_i/X by "
    "others, where the force reaches zero";
constexpr const char* with_floor =
    "keeps the damping F_e X/v_i of the impact that began it, at most that of the floor "
    "slowest_approach on v_i; impacts slower than the floor tend to e = 1";
constexpr const char* tensile_or_not =
    "with tensile = keep at zero penetration, after a tensile phase; with clamp where the force "
    "vanishes, and more is returned";
constexpr const char* without_speed =
    "no velocity in the law, so no floor: damping with the effective mass of the onset, ratio "
    "about xi";
constexpr const char* at_the_set =
    "at the permanent set d_p = d_m (1 - e^2), at zero force, without tension";
constexpr const char* dented =
    "no velocity in the law: loses energy only where the largest penetration is passed; a reload "
    "runs up the unloading line to d_m; the dent is forgotten once the surfaces are apart";

const std::vector<DissipativeEntry>& dissipative_entries() {
  static const std::vector<DissipativeEntry> table = {
      {{.name = "none",
        .title = "No dissipation",
        .formula = "F = F_e",
        .source = "",
        .meant_for = "e = 1",
        .delivers = "e = 1",
        .separation = "at zero penetration, without tension",
        .persistent = "elastic: oscillates without end",
        .caveats = {},
        .parameters = {},
        .linear_only = false},
       make_none,
       delivers_all},
      {{.name = "kelvin-voigt",
        .title = "Kelvin and Voigt",
        .formula = "F = K d + c d', c = 2 xi sqrt(m_r K), xi = -ln e/sqrt(ln^2 e + pi^2)",
        .source = "Dubowsky, S.; Freudenstein, F. J. Eng. Ind. 1971, 93, 305-316, and many others",
        .meant_for = "0 < e <= 1",
        .delivers = "keep: exactly e; clamp: 0.902 for 0.9, 0.550 for 0.5, 0.253 for 0.1",
        .separation = tensile_or_not,
        .persistent = without_speed,
        .caveats =
            {"the force steps to c v_i at first touch",
             "needs a linear elastic law; with another the secant F_e/d takes the place of K"},
        .parameters = {{"restitution", "1, 0.001 to 1"}, {"tensile", "keep or clamp"}},
        .linear_only = true},
       make_kelvin_voigt,
       kelvin_voigt_delivers},
      {{.name = "hunt-crossley",
        .title = "Hunt and Crossley 1975",
        .formula = "F = F_e (1 + 3/2 alpha d'), alpha constant or (1 - e)/v_i",
        .source = "Hunt, K.H.; Crossley, F.R.E. J. Appl. Mech. 1975, 42, 440-445",
        .meant_for = "e near 1",
        .delivers =
            "0.909 for 0.9, 0.663 for 0.5, not less than 0.48; constant alpha: X = 3/2 alpha v_i",
        .separation = free_of_tension,
        .persistent =
            std::string("constant alpha: damping 3/2 alpha F_e, no floor needed; from e: ") +
            with_floor,
        .caveats = {"alpha, if given, takes the place of the restitution"},
        .parameters = {{"restitution", "1, 0 to 1"},
                       {"alpha", "s/m, >= 0"},
                       {"slowest_approach", "m/s, > 0"}},
        .linear_only = false},
       make_hunt_crossley,
       hunt_crossley_delivers},
      {{.name = "herbert-mcwhannell",
        .title = "Herbert and McWhannell 1977",
        .formula = "F = F_e (1 + 6 (1 - e)/((2 e - 1)^2 + 3) d'/v_i)",
        .source = "Herbert, R.G.; McWhannell, D.C. J. Eng. Ind. 1977, 99, 513-518",
        .meant_for = "e above about 0.7",
        .delivers = "0.9009 for 0.9, 0.723 for 0.7, 0.594 for 0.5, not less than 0.48",
        .separation = free_of_tension,
        .persistent = with_floor,
        .caveats = {"identical to marhefka-orin", "published for n = 3/2",
                    "empirical: e = 1 - 0.026 v_i^(1/3), v_i in mm/s, not below 0; not verified "
                    "against the original"},
        .parameters = {{"restitution", "1, 0 to 1"},
                       {"empirical", "yes or no"},
                       {"slowest_approach", "m/s, > 0"}},
        .linear_only = false},
       make_herbert_mcwhannell,
       herbert_mcwhannell_delivers},
      {{.name = "lee-wang-1",
        .title = "Lee and Wang 1983, first function",
        .formula = "F = F_e (1 + 3/4 alpha_1 d'), alpha_1 = (1 - e)/v_i",
        .source = "Lee, T.W.; Wang, A.C. J. Mech. Transm. Autom. Des. 1983, 105, 534-540",
        .meant_for = "all e",
        .delivers = "about 1 - (1 - e)/2: 0.952 for 0.9, 0.799 for 0.5, not less than 0.66",
        .separation = free_of_tension,
        .persistent = with_floor,
        .caveats = {"has half the damping its own e needs", "published for F_e = K d"},
        .parameters = {{"restitution", "1, 0 to 1"}, {"slowest_approach", "m/s, > 0"}},
        .linear_only = false},
       proportional<LeeWang1>,
       proportional_delivers<LeeWang1>},
      {{.name = "lee-wang-2",
        .title = "Lee and Wang 1983, second function",
        .formula =
            "F = K d + 2 m_r w xi T d', T = exp(((d - eps) - |d - eps|) q/eps), w = sqrt(K/m_r)",
        .source = "Lee, T.W.; Wang, A.C. J. Mech. Transm. Autom. Des. 1983, 105, 534-540",
        .meant_for = "0 < e <= 1",
        .delivers = "more than e, the more the wider the transition: for 0.5 and q = 3, 0.554 "
                    "(epsilon 0.1), 0.755 (epsilon 0.5); no closed form",
        .separation = tensile_or_not,
        .persistent = "floor slowest_approach on v_i in eps = epsilon v_i/w; beyond eps damped "
                      "with the ratio xi",
        .caveats = {"the force steps by exp(-2 q) c v_i at first touch",
                    "where the force pulls and is clamped, the contact lets go, may press once "
                    "more near d = 0 because T fades before the spring does, and lets go again",
                    "a corner at d = eps, which is located",
                    "needs a linear elastic law; with another the local stiffness takes the place "
                    "of K and the derivative of the force is not exact"},
        .parameters = {{"restitution", "1, 0.001 to 1"},
                       {"q", "1, > 0 to 100; 2, 3, 4 as published"},
                       {"epsilon", "share of v_i/w, 1e-6 to 1"},
                       {"tensile", "keep or clamp"},
                       {"slowest_approach", "m/s, > 0"}},
        .linear_only = true},
       make_lee_wang_2,
       no_closed_form},
      {{.name = "khulief-shabana",
        .title = "Khulief and Shabana 1986",
        .formula = "F = F_e (1 + 3/4 (1 - e^2) d'/v_i)",
        .source = "Khulief, Y.A.; Shabana, A.A. J. Mech. Transm. Autom. Des. 1986, 108, 38-45; "
                  "Mech. Mach. Theory 1987, 22, 213-224",
        .meant_for = "e near 1",
        .delivers = "0.913 for 0.9, 0.725 for 0.5, not less than 0.66",
        .separation = free_of_tension,
        .persistent = with_floor,
        .caveats = {"published for F_e = K d; lankarani-nikravesh for n = 1"},
        .parameters = {{"restitution", "1, 0 to 1"}, {"slowest_approach", "m/s, > 0"}},
        .linear_only = false},
       proportional<KhuliefShabana>,
       proportional_delivers<KhuliefShabana>},
      {{.name = "lankarani-nikravesh",
        .title = "Lankarani and Nikravesh 1990",
        .formula = "F = F_e (1 + 3/4 (1 - e^2) d'/v_i)",
        .source = "Lankarani, H.M.; Nikravesh, P.E. J. Mech. Des. 1990, 112, 369-376",
        .meant_for = "e near 1",
        .delivers = "0.990 for 0.99, 0.913 for 0.9, 0.725 for 0.5, not less than 0.66",
        .separation = free_of_tension,
        .persistent = with_floor,
        .caveats = {},
        .parameters = {{"restitution", "1, 0 to 1"}, {"slowest_approach", "m/s, > 0"}},
        .linear_only = false},
       proportional<LankaraniNikravesh1990>,
       proportional_delivers<LankaraniNikravesh1990>},
      {{.name = "lankarani-nikravesh-1994",
        .title = "Lankarani and Nikravesh 1994, permanent indentation",
        .formula = "F = F_e(d) loading, F_e((d - d_p)/e^2) unloading, d_p = d_m (1 - e^2); for K "
                   "d^n: F_m ((d - d_p)/(d_m - d_p))^n",
        .source = "Lankarani, H.M.; Nikravesh, P.E. Nonlinear Dyn. 1994, 5, 193-207",
        .meant_for = "0 < e <= 1, impacts that leave a dent",
        .delivers = "exactly e",
        .separation = at_the_set,
        .persistent = dented,
        .caveats = {},
        .parameters = {{"restitution", "1, 0.001 to 1"}},
        .linear_only = false},
       simple<LankaraniNikravesh1994>,
       delivers_asked},
      {{.name = "tsuji",
        .title = "Tsuji, Tanaka and Ishida 1992",
        .formula = "F = F_e + chi sqrt(m_r K) d^((n-1)/2) d', chi = -sqrt(2 (n + 1)) ln "
                   "e/sqrt(ln^2 e + pi^2)",
        .source = "Tsuji, Y.; Tanaka, T.; Ishida, T. Powder Technol. 1992, 71, 239-250",
        .meant_for = "0 < e <= 1",
        .delivers = "keep: exactly e; clamp: 0.902 for 0.9, 0.550 for 0.5, 0.253 for 0.1",
        .separation = tensile_or_not,
        .persistent = without_speed,
        .caveats =
            {"published for n = 3/2, chi as a curve", "tension up to 14 % of the largest force",
             "with an elastic law other than K d^n: n + 1 = F_e d/U, which is exact-restitution"},
        .parameters = {{"restitution", "1, 0.001 to 1"}, {"tensile", "keep or clamp"}},
        .linear_only = false},
       tensile<Tsuji>,
       ratio_delivers},
      {{.name = "marhefka-orin",
        .title = "Marhefka and Orin 1999",
        .formula = "F = F_e (1 + 3 alpha (2 - alpha v_i)/(2 (2 - 3 alpha v_i + 3 alpha^2 v_i^2 - "
                   "alpha^3 v_i^3)) d'), alpha v_i = 1 - e",
        .source = "Marhefka, D.; Orin, D. IEEE Trans. Syst. Man Cybern. A 1999, 29, 566-572",
        .meant_for = "e above about 0.7",
        .delivers = "0.9009 for 0.9, 0.723 for 0.7, 0.594 for 0.5, not less than 0.48",
        .separation = free_of_tension,
        .persistent = with_floor,
        .caveats = {"identical to herbert-mcwhannell"},
        .parameters = {{"restitution", "1, 0 to 1"}, {"slowest_approach", "m/s, > 0"}},
        .linear_only = false},
       proportional<MarhefkaOrin>,
       proportional_delivers<MarhefkaOrin>},
      {{.name = "marhefka-orin-simplified",
        .title = "Marhefka and Orin 1999, simplified",
        .formula =
            "F = F_e (1 + 3 alpha (2 - alpha v_i)/(2 (2 - 3 alpha v_i)) d'), alpha v_i = 1 - e",
        .source = "Marhefka, D.; Orin, D. IEEE Trans. Syst. Man Cybern. A 1999, 29, 566-572",
        .meant_for = "e above about 0.7",
        .delivers = "0.8994 for 0.9, 0.680 for 0.7, 0.380 for 0.5",
        .separation = free_of_tension,
        .persistent = with_floor,
        .caveats = {"infinite damping at e = 1/3, a source of energy below: refused"},
        .parameters = {{"restitution", "1, > 1/3 to 1"}, {"slowest_approach", "m/s, > 0"}},
        .linear_only = false},
       proportional<MarhefkaOrinSimplified>,
       proportional_delivers<MarhefkaOrinSimplified>},
      {{.name = "gonthier",
        .title = "Gonthier, McPhee, Lange and Piedboeuf 2004",
        .formula = "F = F_e (1 + d_G/(e v_i) d'), (1 + d_G/e)/(1 - d_G) = exp(d_G (1 + 1/e))",
        .source = "Gonthier, Y.; McPhee, J.; Lange, C.; Piedboeuf, J.C. Multibody Syst. Dyn. 2004, "
                  "11, 209-233",
        .meant_for = "0 < e <= 1",
        .delivers = "exactly e",
        .separation = free_of_tension,
        .persistent = with_floor,
        .caveats = {"damping grows as 1/e towards e = 0"},
        .parameters = {{"restitution", "1, 0.001 to 1"}, {"slowest_approach", "m/s, > 0"}},
        .linear_only = false},
       proportional<Gonthier>,
       proportional_delivers<Gonthier>},
      {{.name = "zhang-sharf",
        .title = "Zhang and Sharf 2009, exact form",
        .formula = "F = F_e (1 + chi d'), chi v_i (1 + e) = ln((1 + chi v_i)/(1 - e chi v_i))",
        .source = "Zhang, Y.; Sharf, I. J. Appl. Mech. 2009, 76, 051002",
        .meant_for = "0 < e <= 1",
        .delivers = "exactly e",
        .separation = free_of_tension,
        .persistent = with_floor,
        .caveats = {"the same law as gonthier",
                    "the original was not at hand; the balance is derived in the library"},
        .parameters = {{"restitution", "1, 0.001 to 1"}, {"slowest_approach", "m/s, > 0"}},
        .linear_only = false},
       proportional<ZhangSharf>,
       proportional_delivers<ZhangSharf>},
      {{.name = "flores",
        .title = "Flores, Machado, Silva and Martins 2011",
        .formula = "F = F_e (1 + 8 (1 - e)/(5 e) d'/v_i)",
        .source = "Flores, P.; Machado, M.; Silva, M.T.; Martins, J.M. Multibody Syst. Dyn. 2011, "
                  "25, 357-375",
        .meant_for = "0 < e <= 1",
        .delivers = "0.894 for 0.9, 0.683 for 0.7, 0.470 for 0.5, 0.069 for 0.1",
        .separation = free_of_tension,
        .persistent = with_floor,
        .caveats = {"8/5 was derived for n = 3/2"},
        .parameters = {{"restitution", "1, 0.001 to 1"}, {"slowest_approach", "m/s, > 0"}},
        .linear_only = false},
       proportional<Flores>,
       proportional_delivers<Flores>},
      {{.name = "gharib-hurmuzlu",
        .title = "Gharib and Hurmuzlu 2012, first law",
        .formula = "F = F_e (1 + d'/(e v_i))",
        .source = "Gharib, M.; Hurmuzlu, Y. J. Appl. Mech. 2012, 79",
        .meant_for = "small e only",
        .delivers = "0.09998 for 0.1, 0.282 for 0.3, 0.411 for 0.5, 0.567 for 0.9, 0.594 for 1",
        .separation = free_of_tension,
        .persistent = with_floor,
        .caveats = {"loses energy even with e = 1",
                    "e v_i is the speed the rebound tends to and never reaches"},
        .parameters = {{"restitution", "1, 0.001 to 1"}, {"slowest_approach", "m/s, > 0"}},
        .linear_only = false},
       proportional<GharibHurmuzlu>,
       proportional_delivers<GharibHurmuzlu>},
      {{.name = "gharib-hurmuzlu-2",
        .title = "Gharib and Hurmuzlu 2012, second law, permanent indentation",
        .formula = "F = K_c d^n compression, K_r (d - d_p)^n restitution, K_r = K_c/e^(2 n), d_p = "
                   "d_m (1 - e^2)",
        .source = "Gharib, M.; Hurmuzlu, Y. J. Appl. Mech. 2012, 79",
        .meant_for = "0 < e <= 1, impacts that leave a dent",
        .delivers = "exactly e",
        .separation = at_the_set,
        .persistent = dented,
        .caveats = {"identical to lankarani-nikravesh-1994, also in its form for any elastic law",
                    "e is the energetic coefficient of restitution"},
        .parameters = {{"restitution", "1, 0.001 to 1"}},
        .linear_only = false},
       simple<GharibHurmuzlu2>,
       delivers_asked},
      {{.name = "hu-guo",
        .title = "Hu and Guo 2015",
        .formula = "F = F_e (1 + 3 (1 - e)/(2 e) d'/v_i)",
        .source = "Hu, S.; Guo, X. Multibody Syst. Dyn. 2015, 35, 131-151",
        .meant_for = "0 < e <= 1",
        .delivers = "0.8999 for 0.9, 0.697 for 0.7, 0.488 for 0.5, 0.074 for 0.1",
        .separation = free_of_tension,
        .persistent = with_floor,
        .caveats = {},
        .parameters = {{"restitution", "1, 0.001 to 1"}, {"slowest_approach", "m/s, > 0"}},
        .linear_only = false},
       proportional<HuGuo>,
       proportional_delivers<HuGuo>},
      {{.name = "carvalho-martins",
        .title = "Carvalho and Martins 2019",
        .formula = "F = F_e (1 + 3 (1 - e)(11 - e)/(2 (1 + 9 e)) d'/v_i)",
        .source = "Carvalho, A.S.; Martins, J.M. Mech. Mach. Theory 2019, 139, 174-194",
        .meant_for = "all e",
        .delivers = "within 2e-4 of e for e >= 0.5, 0.304 for 0.3, 0.129 for 0.1, 0.061 for 0",
        .separation = free_of_tension,
        .persistent = with_floor,
        .caveats = {"the original was not at hand; as quoted by the documentation of Exudyn, there "
                    "for e > 1/3, checked against the exact balance"},
        .parameters = {{"restitution", "1, 0 to 1"}, {"slowest_approach", "m/s, > 0"}},
        .linear_only = false},
       proportional<CarvalhoMartins>,
       proportional_delivers<CarvalhoMartins>},
      {{.name = "exact-restitution",
        .title = "Damping by the stored energy",
        .formula =
            "F = F_e + c d', c = 2 xi sqrt(m_r) F_e/sqrt(2 U), xi = -ln e/sqrt(ln^2 e + pi^2)",
        .source = "derived in contact/laws/forms/viscous_damping.hpp; tsuji for any elastic law",
        .meant_for = "0 < e <= 1",
        .delivers = "keep: exactly e for every elastic law; clamp: 0.902 for 0.9, 0.550 for 0.5, "
                    "0.253 for 0.1",
        .separation = tensile_or_not,
        .persistent = without_speed,
        .caveats = {"tension up to 14 % of the largest force"},
        .parameters = {{"restitution", "1, 0.001 to 1"}, {"tensile", "keep or clamp"}},
        .linear_only = false},
       tensile<ExactRestitution>,
       ratio_delivers},
  };
  return table;
}

const DissipativeEntry& find_dissipative_entry(std::string_view name) {
  for (const DissipativeEntry& each : dissipative_entries())
    if (each.note.name == name) return each;
  std::string known;
  for (const DissipativeEntry& each : dissipative_entries())
    known += (known.empty() ? "" : ", ") + each.note.name;
  throw ModelError(fmt::format("dissipative law '{}' is unknown; known are {}", name, known));
}

}  // namespace

const std::vector<DissipativeNote>& dissipative_catalog() {
  static const std::vector<DissipativeNote> notes = [] {
    std::vector<DissipativeNote> all;
    for (const DissipativeEntry& each : dissipative_entries()) all.push_back(each.note);
    return all;
  }();
  return notes;
}

const DissipativeNote& find_dissipative(std::string_view name) {
  return find_dissipative_entry(name).note;
}

DissipativeLaw make_dissipative(std::string_view name, const DissipativeArguments& arguments) {
  return find_dissipative_entry(name).make(arguments);
}

std::optional<double> closed_form_restitution(std::string_view name,
                                              const DissipativeArguments& arguments, double n,
                                              double approach_velocity) {
  const DissipativeEntry& entry = find_dissipative_entry(name);
  entry.make(arguments);  // checks them
  require_positive(fmt::format("law '{}'", name), "approach velocity", approach_velocity, "m/s");
  return entry.delivers(arguments, n, approach_velocity);
}

}  // namespace yoke
