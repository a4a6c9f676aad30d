// SUNDIALS CVODE (from the library CVODES, which adds quadratures): variable order, dense Newton iteration with CVODE's own
// difference-quotient Jacobian for BDF, fixed-point iteration for Adams.
#pragma once

#include <cvodes/cvodes.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <memory>
#include <stdexcept>

#include "bench/work_precision/trajectory.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// One CVODE object, made once and set back for every member.
struct Cvode {
    int method;     // CV_BDF or CV_ADAMS
    int max_order;  // CVODE's own limits: 5 and 12

    template <class System> class Solver;
};

namespace detail {

inline void check(int flag, char const* call) {
    if (flag < 0) throw std::runtime_error(std::string(call) + " failed: " + std::to_string(flag));
}

struct SundialsDelete {
    void operator()(N_Vector v) const { N_VDestroy(v); }
    void operator()(SUNMatrix m) const { SUNMatDestroy(m); }
    void operator()(SUNLinearSolver s) const { SUNLinSolFree(s); }
    void operator()(SUNNonlinearSolver s) const { SUNNonlinSolFree(s); }
    void operator()(SUNContext c) const { SUNContext_Free(&c); }
};
template <class Handle> using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, SundialsDelete>;

inline SUNContext new_context() {
    SUNContext context = nullptr;
    check(SUNContext_Create(nullptr, &context), "SUNContext_Create");
    return context;
}

struct CvodeDelete {
    void operator()(void* memory) const { CVodeFree(&memory); }
};

}  // namespace detail

template <class System> class Cvode::Solver {
public:
    explicit Solver(Cvode const& options)
        : context_(detail::new_context()),
          state_(N_VNew_Serial(n, context_.get())),
          absolute_(N_VNew_Serial(n, context_.get())),
          memory_(CVodeCreate(options.method, context_.get())) {
        using detail::check;
        check(CVodeInit(memory_.get(), &rates, 0, state_.get()), "CVodeInit");
        check(CVodeSetErrFile(memory_.get(), nullptr), "CVodeSetErrFile");
        check(CVodeSetMaxOrd(memory_.get(), options.max_order), "CVodeSetMaxOrd");
        check(CVodeSetMaxNumSteps(memory_.get(), steps_per_call), "CVodeSetMaxNumSteps");
        if (options.method == CV_BDF) {
            matrix_.reset(SUNDenseMatrix(n, n, context_.get()));
            linear_.reset(SUNLinSol_Dense(state_.get(), matrix_.get(), context_.get()));
            // The tolerances must be known before the linear solver's first use, not before it is attached.
            check(CVodeSetLinearSolver(memory_.get(), linear_.get(), matrix_.get()), "CVodeSetLinearSolver");
        } else {
            nonlinear_.reset(SUNNonlinSol_FixedPoint(state_.get(), 0, context_.get()));
            check(CVodeSetNonlinearSolver(memory_.get(), nonlinear_.get()), "CVodeSetNonlinearSolver");
        }
        if constexpr (audits > 0) {
            integrals_.reset(N_VNew_Serial(audits, context_.get()));
            absolute_integrals_.reset(N_VNew_Serial(audits, context_.get()));
        }
    }

    Trajectory<System> run(System const& system, Limits const& limits) {
        using detail::check;
        double* const x = N_VGetArrayPointer(state_.get());
        std::copy(system.start.begin(), system.start.end(), x);
        for (int i = 0; i < n; ++i) N_VGetArrayPointer(absolute_.get())[i] = limits.tolerance * system.scale[i];
        check(CVodeReInit(memory_.get(), 0, state_.get()), "CVodeReInit");
        check(CVodeSVtolerances(memory_.get(), limits.tolerance, absolute_.get()), "CVodeSVtolerances");
        check(CVodeSetUserData(memory_.get(), const_cast<System*>(&system)), "CVodeSetUserData");
        check(CVodeSetMaxStep(memory_.get(), limits.max_step), "CVodeSetMaxStep");
        check(CVodeSetStopTime(memory_.get(), limits.end_time), "CVodeSetStopTime");
        if constexpr (audits > 0) {
            if (limits.audited) begin_audit(system, limits);
        }
        Trajectory<System> result{};
        double t = 0;
        int flag = CV_TOO_MUCH_WORK;
        while (flag == CV_TOO_MUCH_WORK && bench::Clock::now() <= limits.deadline) {
            flag = CVode(memory_.get(), limits.end_time, state_.get(), &t, CV_NORMAL);
        }
        result.finished = flag >= 0;
        std::copy(x, x + n, result.end.begin());
        if constexpr (audits > 0) {
            if (limits.audited && result.finished) {
                check(CVodeGetQuad(memory_.get(), &t, integrals_.get()), "CVodeGetQuad");
                double const* const values = N_VGetArrayPointer(integrals_.get());
                std::copy(values, values + audits, result.end.begin() + n);
            }
        }
        return result;
    }

private:
    static constexpr int n = System::size;
    static constexpr int audits = System::audits;
    static constexpr long steps_per_call = 500;

    static int rates(double t, N_Vector x, N_Vector dxdt, void* system) {
        double* const slope = NV_DATA_S(dxdt);
        static_cast<System const*>(system)->rates(t, NV_DATA_S(x), slope);
        double sum = 0;
        for (int i = 0; i < n; ++i) sum += slope[i] * 0;
        return sum == 0 ? 0 : 1;  // not finite: CVODE tries a smaller step
    }

    static int powers(double t, N_Vector x, N_Vector power, void* system) {
        if constexpr (audits > 0) static_cast<System const*>(system)->powers(t, NV_DATA_S(x), NV_DATA_S(power));
        return 0;
    }

    /// The audit's integrals as quadratures, which the Newton iteration does not see but the error test does.
    void begin_audit(System const& system, Limits const& limits) {
        using detail::check;
        N_VConst(0, integrals_.get());
        double* const absolute = N_VGetArrayPointer(absolute_integrals_.get());
        for (int i = 0; i < audits; ++i) absolute[i] = limits.tolerance * system.scale[n + i];
        if (has_audit_) {
            check(CVodeQuadReInit(memory_.get(), integrals_.get()), "CVodeQuadReInit");
        } else {
            check(CVodeQuadInit(memory_.get(), &powers, integrals_.get()), "CVodeQuadInit");
            check(CVodeSetQuadErrCon(memory_.get(), 1), "CVodeSetQuadErrCon");
            has_audit_ = true;
        }
        check(CVodeQuadSVtolerances(memory_.get(), limits.tolerance, absolute_integrals_.get()),
              "CVodeQuadSVtolerances");
    }

    detail::Owned<SUNContext> context_;
    detail::Owned<N_Vector> state_, absolute_, integrals_, absolute_integrals_;
    detail::Owned<SUNMatrix> matrix_;
    detail::Owned<SUNLinearSolver> linear_;
    detail::Owned<SUNNonlinearSolver> nonlinear_;
    std::unique_ptr<void, detail::CvodeDelete> memory_;
    bool has_audit_ = false;
};

}  // namespace slideway::inline SLIDEWAY_ISA
