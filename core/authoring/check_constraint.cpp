// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <algorithm>

#include <yoke/core/authoring/check_tools.hpp>
#include <yoke/core/equations/curvature_pattern.hpp>

namespace yoke::checking {
namespace {

// For the multipliers of K: never zero, never the same.
double ugly_multiplier(int row, unsigned seed) {
  const double size = 1.7 + 0.9 * row + 0.1 * (seed % 7);
  return row % 2 == 0 ? size : -size;
}

struct ConstraintBlocks {
  Values phi, G, phi_t, gamma, H, K;
};

class ConstraintChecker {
 public:
  ConstraintChecker(const Constraint& element, const Model& model, const State& state,
                    const CheckOptions& options, ElementCheck& check)
      : element_(element),
        probe_(model, state),
        options_(options),
        rows_(element.rows()),
        columns_(element.columns()),
        skip_(ground_columns(element.bodies())),
        v_(probe_.velocities(element.bodies())),
        comparison_(check) {
    for (const Parameter& p : element.parameters()) parameters_.push_back(p.value);
    for (int r = 0; r < rows_; ++r) lambda_.push_back(ugly_multiplier(r, options.seed));
  }

  /// True if G was seen to be other than zero.
  bool run() {
    all_ = evaluate(true, true, true, true, true, true);
    check_finite();
    check_alone();
    check_pattern();
    check_by_position();
    check_by_time();
    return any_nonzero(all_.G, skip_);
  }

 private:
  ConstraintBlocks evaluate(bool phi, bool G, bool phi_t, bool gamma, bool H, bool K) const {
    const std::size_t rows = index(rows_), columns = index(columns_);
    ConstraintBlocks b{.phi = Values(rows),
                       .G = Values(rows * columns),
                       .phi_t = Values(rows),
                       .gamma = Values(rows),
                       .H = Values(rows * columns),
                       .K = Values(columns * columns)};
    element_.evaluate(probe_.motion(), {.phi = phi ? b.phi.data() : nullptr,
                                        .G = G ? b.G.data() : nullptr,
                                        .phi_t = phi_t ? b.phi_t.data() : nullptr,
                                        .gamma = gamma ? b.gamma.data() : nullptr,
                                        .H = H ? b.H.data() : nullptr,
                                        .K = K ? b.K.data() : nullptr,
                                        .lambda = K ? lambda_.data() : nullptr,
                                        .parameters = parameters_.data()});
    return b;
  }

  void check_finite() {
    comparison_.require_finite_block("phi", all_.phi);
    comparison_.require_finite_block("G", all_.G);
    comparison_.require_finite_block("phi_t", all_.phi_t);
    comparison_.require_finite_block("gamma", all_.gamma);
    comparison_.require_finite_block("H", all_.H);
    comparison_.require_finite_block("K", all_.K);
  }

  void check_alone() {
    comparison_.require_same("phi", evaluate(true, false, false, false, false, false).phi,
                             all_.phi);
    comparison_.require_same("G", evaluate(false, true, false, false, false, false).G, all_.G);
    comparison_.require_same("phi_t", evaluate(false, false, true, false, false, false).phi_t,
                             all_.phi_t);
    comparison_.require_same("gamma", evaluate(false, false, false, true, false, false).gamma,
                             all_.gamma);
    comparison_.require_same("H", evaluate(false, false, false, false, true, false).H, all_.H);
    comparison_.require_same("K", evaluate(false, false, false, false, false, true).K, all_.K);
  }

  void check_pattern() {
    for (int r = 0; r < rows_; ++r)
      for (int c = 0; c < columns_; ++c) {
        const std::size_t i = index(r * columns_ + c);
        if (element_.in_pattern(r, c) || skip_[index(c)]) continue;
        if (all_.G[i] != 0.0 || all_.H[i] != 0.0)
          comparison_.complain(fmt::format(
              "row {} column {} is outside the declared pattern but G = {:g}, H = {:g} there", r, c,
              all_.G[i], all_.H[i]));
      }
    check_curvature();
    if (!element_.rheonomic() && largest(all_.phi_t) != 0.0)
      comparison_.complain(
          "phi_t is not zero but rheonomic() says that phi does not depend on time");
  }

  void check_curvature() {
    const auto* curvature = dynamic_cast<const CurvaturePattern*>(&element_);
    for (int j = 0; curvature != nullptr && j < columns_; ++j)
      for (int l = 0; l < columns_; ++l)
        if (const double K = all_.K[index(j * columns_ + l)];
            K != 0.0 && !curvature->is_curved(j, l))
          comparison_.complain(fmt::format(
              "second derivatives by columns {} and {} are said to be zero but K = {:g} there", j,
              l, K));
  }

  // phi, G v + phi_t and G^T lambda one after the other, at the probe's place with v held.
  Values quantities() const {
    const ConstraintBlocks b = evaluate(true, true, true, false, false, false);
    Values f = b.phi;
    for (int r = 0; r < rows_; ++r) {
      double rate = b.phi_t[index(r)];
      for (int c = 0; c < columns_; ++c) rate += b.G[index(r * columns_ + c)] * v_[index(c)];
      f.push_back(rate);
    }
    for (int c = 0; c < columns_; ++c) {
      double force = 0.0;
      for (int r = 0; r < rows_; ++r) force += b.G[index(r * columns_ + c)] * lambda_[index(r)];
      f.push_back(force);
    }
    return f;
  }

  template <class Move>
  Values derivative(double scale, const Move& move) {
    const Probe here = probe_;
    const Values result = differentiate(
        [&](double h) {
          move(h);
          Values f = quantities();
          probe_ = here;
          return f;
        },
        scale);
    return result;
  }

  void check_by_position() {
    Values G(all_.G.size()), H(all_.H.size()), K(all_.K.size());
    for (int c = 0; c < columns_; ++c) {
      if (skip_[index(c)]) continue;
      const BodyId id = element_.bodies()[index(c / 3)];
      const Values d = derivative(step_scale(c, options_),
                                  [&](double h) { probe_.move_coordinate(id, c % 3, h); });
      for (int r = 0; r < rows_; ++r) {
        G[index(r * columns_ + c)] = d[index(r)];
        H[index(r * columns_ + c)] = d[index(rows_ + r)];
      }
      for (int i = 0; i < columns_; ++i) K[index(i * columns_ + c)] = d[index(2 * rows_ + i)];
    }
    forget_ground(all_.G, rows_);
    forget_ground(all_.H, rows_);
    forget_ground(all_.K, columns_);
    for (int i = 0; i < columns_; ++i)  // rows of the ground in K
      if (skip_[index(i)])
        for (int c = 0; c < columns_; ++c)
          all_.K[index(i * columns_ + c)] = K[index(i * columns_ + c)] = 0.0;
    const double size = largest(all_.G);
    comparison_.compare("G", rows_, columns_, all_.G, G, skip_, 0.0);
    comparison_.compare("H", rows_, columns_, all_.H, H, skip_, size * largest(v_));
    comparison_.compare("K", columns_, columns_, all_.K, K, skip_, size * largest(lambda_));
  }

  void forget_ground(Values& block, int rows) const {
    for (int r = 0; r < rows; ++r)
      for (int c = 0; c < columns_; ++c)
        if (skip_[index(c)]) block[index(r * columns_ + c)] = 0.0;
  }

  void check_by_time() {
    const std::vector<bool> keep{false};
    const double size = largest(all_.G), speed = largest(v_);
    const Values by_time = derivative(options_.time, [&](double h) { probe_.advance_time(h); });
    comparison_.compare("phi_t", rows_, 1, all_.phi_t,
                        Values(by_time.begin(), by_time.begin() + rows_), keep, size);
    const Values along = derivative(drift_scale(v_, options_), [&](double h) { probe_.drift(h); });
    Values gamma;
    for (int r = 0; r < rows_; ++r) gamma.push_back(-along[index(rows_ + r)]);
    comparison_.compare("gamma", rows_, 1, all_.gamma, gamma, keep, size * speed * speed);
  }

  const Constraint& element_;
  Probe probe_;
  const CheckOptions& options_;
  int rows_, columns_;
  std::vector<bool> skip_;
  Values v_, lambda_, parameters_;
  ConstraintBlocks all_;
  Comparison comparison_;
};

}  // namespace

bool check_at(const Constraint& element, const Model& model, const State& state,
              const CheckOptions& options, ElementCheck& check) {
  return ConstraintChecker(element, model, state, options, check).run();
}

}  // namespace yoke::checking
