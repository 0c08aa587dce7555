// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// SUNDIALS 6.4 to 7.x under the names of 7.1. What else differs between them, the way errors are
// reported, is in context.cpp.
#pragma once

#include <arkode/arkode_erkstep.h>
#include <sundials/sundials_config.h>
#include <sundials/sundials_types.h>

namespace yoke {

#define YOKE_SUNDIALS_VERSION (SUNDIALS_VERSION_MAJOR * 100 + SUNDIALS_VERSION_MINOR)

#if YOKE_SUNDIALS_VERSION >= 700
inline const SUNComm no_communicator = SUN_COMM_NULL;
#else
inline constexpr void* no_communicator = nullptr;
#endif

#if YOKE_SUNDIALS_VERSION < 701
// ARKODE had one set of functions for each of its steppers.
inline int ARKodeSetUserData(void* m, void* data) { return ERKStepSetUserData(m, data); }
inline int ARKodeWFtolerances(void* m, ARKEwtFn f) { return ERKStepWFtolerances(m, f); }
inline int ARKodeSVtolerances(void* m, sunrealtype r, N_Vector a) {
  return ERKStepSVtolerances(m, r, a);
}
inline int ARKodeSetMaxNumSteps(void* m, long n) { return ERKStepSetMaxNumSteps(m, n); }
inline int ARKodeSetMaxErrTestFails(void* m, int n) { return ERKStepSetMaxErrTestFails(m, n); }
inline int ARKodeSetInterpolantDegree(void* m, int degree) {
  return ERKStepSetInterpolantDegree(m, degree);
}
inline int ARKodeSetPostprocessStepFn(void* m, ARKPostProcessFn f) {
  return ERKStepSetPostprocessStepFn(m, f);
}
inline int ARKodeRootInit(void* m, int n, ARKRootFn f) { return ERKStepRootInit(m, n, f); }
inline int ARKodeSetRootDirection(void* m, int* d) { return ERKStepSetRootDirection(m, d); }
inline int ARKodeSetNoInactiveRootWarn(void* m) { return ERKStepSetNoInactiveRootWarn(m); }
inline int ARKodeSetStopTime(void* m, sunrealtype t) { return ERKStepSetStopTime(m, t); }
inline int ARKodeEvolve(void* m, sunrealtype t, N_Vector y, sunrealtype* reached, int task) {
  return ERKStepEvolve(m, t, y, reached, task);
}
inline int ARKodeReset(void* m, sunrealtype t, N_Vector y) { return ERKStepReset(m, t, y); }
inline int ARKodeGetDky(void* m, sunrealtype t, int k, N_Vector y) {
  return ERKStepGetDky(m, t, k, y);
}
inline int ARKodeGetRootInfo(void* m, int* found) { return ERKStepGetRootInfo(m, found); }
inline int ARKodeGetCurrentTime(void* m, sunrealtype* t) { return ERKStepGetCurrentTime(m, t); }
inline int ARKodeGetLastStep(void* m, sunrealtype* h) { return ERKStepGetLastStep(m, h); }
inline int ARKodeGetCurrentStep(void* m, sunrealtype* h) { return ERKStepGetCurrentStep(m, h); }
inline int ARKodeSetInitStep(void* m, sunrealtype h) { return ERKStepSetInitStep(m, h); }
inline int ARKodeGetNumSteps(void* m, long* n) { return ERKStepGetNumSteps(m, n); }
inline int ARKodeGetNumErrTestFails(void* m, long* n) { return ERKStepGetNumErrTestFails(m, n); }
inline int ARKodeGetErrWeights(void* m, N_Vector w) { return ERKStepGetErrWeights(m, w); }
inline int ARKodeGetEstLocalErrors(void* m, N_Vector e) { return ERKStepGetEstLocalErrors(m, e); }
inline void ARKodeFree(void** m) { ERKStepFree(m); }
#endif

}  // namespace yoke
