// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// SUNDIALS' context, which every vector, matrix, solver and integrator is created with, and where
// their error messages go. Each run has a context of its own: nothing is shared between threads.
#pragma once

#include <sundials/sundials_context.h>

#include <yoke/integrators/sundials/callback_failure.hpp>

namespace yoke {

enum class SundialsPackage { arkode, cvode, ida, kinsol };

class SundialsContext {
 public:
  /// Errors are kept in `failure`, which must outlive this; nothing is printed. Warnings are
  /// dropped.
  explicit SundialsContext(CallbackFailure& failure);
  ~SundialsContext();
  SundialsContext(const SundialsContext&) = delete;
  SundialsContext& operator=(const SundialsContext&) = delete;

  operator SUNContext() const { return context_; }
  /// To be called once for each integrator or solver created in this context.
  void report_errors_of(SundialsPackage package, void* memory);

 private:
  CallbackFailure& failure_;
  SUNContext context_ = nullptr;
  [[maybe_unused]] void* logger_ = nullptr;  // of 7.x
};

}  // namespace yoke
