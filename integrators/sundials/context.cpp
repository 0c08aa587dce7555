// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <arkode/arkode_erkstep.h>
#include <cvodes/cvodes.h>
#include <idas/idas.h>
#include <kinsol/kinsol.h>
#include <sundials/sundials_logger.h>

#include <yoke/integrators/sundials/compatibility.hpp>
#include <yoke/integrators/sundials/context.hpp>

namespace yoke {

#if YOKE_SUNDIALS_VERSION >= 700

// One error handler for all that is created in the context. Warnings bypass it and go to a logger;
// one that was given no files writes nothing.
SundialsContext::SundialsContext(CallbackFailure& failure) : failure_(failure) {
  SUNContext_Create(no_communicator, &context_);
  SUNLogger silent = nullptr;
  SUNLogger_Create(no_communicator, 0, &silent);
  SUNContext_SetLogger(context_, silent);
  logger_ = silent;
  SUNContext_ClearErrHandlers(context_);
  SUNContext_PushErrHandler(
      context_,
      [](int, const char*, const char*, const char* message, SUNErrCode code, void* kept,
         SUNContext) {
        static_cast<CallbackFailure*>(kept)->report(code, message ? message : SUNGetErrMsg(code));
      },
      &failure_);
}

SundialsContext::~SundialsContext() {
  SUNContext_Free(&context_);
  auto* logger = static_cast<SUNLogger>(logger_);
  SUNLogger_Destroy(&logger);
}

void SundialsContext::report_errors_of(SundialsPackage, void*) {}

#else

// Every integrator has an error handler of its own, which gets the warnings too.
SundialsContext::SundialsContext(CallbackFailure& failure) : failure_(failure) {
  SUNContext_Create(no_communicator, &context_);
}

SundialsContext::~SundialsContext() { SUNContext_Free(&context_); }

void SundialsContext::report_errors_of(SundialsPackage package, void* memory) {
  const auto report = [](int code, const char*, const char*, char* message, void* kept) {
    static_cast<CallbackFailure*>(kept)->report(code, message);
  };
  switch (package) {
    case SundialsPackage::arkode:
      ERKStepSetErrHandlerFn(memory, report, &failure_);
      break;
    case SundialsPackage::cvode:
      CVodeSetErrHandlerFn(memory, report, &failure_);
      break;
    case SundialsPackage::ida:
      IDASetErrHandlerFn(memory, report, &failure_);
      break;
    case SundialsPackage::kinsol:
      KINSetErrHandlerFn(memory, report, &failure_);
      break;
  }
}

#endif

}  // namespace yoke
