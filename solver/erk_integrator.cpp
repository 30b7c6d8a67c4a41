#include "solver/erk_integrator.hpp"

#include <algorithm>

#include <arkode/arkode_erkstep.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>

#include "core/error.hpp"

namespace ballbot {
namespace {

constexpr long kMaxStepsPerCall = 20000;

void demand(bool ok, const char* what) {
  if (!ok) throw NumericalError(std::string("SUNDIALS: ") + what + " failed");
}

void keepQuiet(int, const char*, const char*, char*, void*) {}  // trouble is a return value here

}  // namespace

class ErkIntegrator::Impl {
 public:
  Impl(int dimension, Flow flow, void* user, double relative, const double* absolute,
       double initial_step)
      : dimension_(dimension), flow_(flow), user_(user), initial_step_(initial_step) {
    demand(SUNContext_Create(nullptr, &context_) == 0, "SUNContext_Create");
    y_ = N_VNew_Serial(dimension, context_);
    tolerance_ = N_VNew_Serial(dimension, context_);
    demand(y_ && tolerance_, "N_VNew_Serial");
    N_VConst(0, y_);
    std::copy(absolute, absolute + dimension, N_VGetArrayPointer(tolerance_));
    memory_ = ERKStepCreate(&Impl::evaluate, 0, y_, context_);
    demand(memory_, "ERKStepCreate");
    demand(ERKStepSVtolerances(memory_, relative, tolerance_) == 0, "ERKStepSVtolerances");
    demand(ERKStepSetUserData(memory_, this) == 0, "ERKStepSetUserData");
    demand(ERKStepSetOrder(memory_, 5) == 0, "ERKStepSetOrder");
    demand(ERKStepSetMaxNumSteps(memory_, kMaxStepsPerCall) == 0, "ERKStepSetMaxNumSteps");
    demand(ERKStepSetErrHandlerFn(memory_, keepQuiet, nullptr) == 0, "ERKStepSetErrHandlerFn");
  }
  ~Impl() {
    ERKStepFree(&memory_);
    N_VDestroy(tolerance_);
    N_VDestroy(y_);
    SUNContext_Free(&context_);
  }

  bool start(double t, const double* y) noexcept {
    std::copy(y, y + dimension_, N_VGetArrayPointer(y_));
    t_ = t;
    return ERKStepReInit(memory_, &Impl::evaluate, t, y_) == 0 &&
           ERKStepSetInitStep(memory_, initial_step_) == 0;
  }
  bool advanceTo(double t) noexcept {
    return ERKStepSetStopTime(memory_, t) == 0 &&
           ERKStepEvolve(memory_, t, y_, &t_, ARK_NORMAL) >= 0 && t_ == t;
  }
  const double* y() const noexcept { return N_VGetArrayPointer(y_); }
  long flowCalls() const noexcept {
    long calls = 0;
    ERKStepGetNumRhsEvals(memory_, &calls);
    return calls;
  }

 private:
  static int evaluate(realtype t, N_Vector y, N_Vector dy, void* self) {
    const Impl& impl = *static_cast<Impl*>(self);
    impl.flow_(t, N_VGetArrayPointer(y), N_VGetArrayPointer(dy), impl.user_);
    return 0;
  }

  int dimension_;
  Flow flow_;
  void* user_;
  double initial_step_;
  double t_ = 0;
  SUNContext context_ = nullptr;
  N_Vector y_ = nullptr, tolerance_ = nullptr;
  void* memory_ = nullptr;
};

ErkIntegrator::ErkIntegrator(int dimension, Flow flow, void* user, double relative,
                             const double* absolute, double initial_step)
    : impl_(std::make_unique<Impl>(dimension, flow, user, relative, absolute, initial_step)) {}
ErkIntegrator::~ErkIntegrator() = default;

bool ErkIntegrator::start(double t, const double* y) noexcept { return impl_->start(t, y); }
bool ErkIntegrator::advanceTo(double t) noexcept { return impl_->advanceTo(t); }
const double* ErkIntegrator::y() const noexcept { return impl_->y(); }
long ErkIntegrator::flowCalls() const noexcept { return impl_->flowCalls(); }

}  // namespace ballbot
