// Everything a program needs: problems, methods, backends, the time loop and its observers.
//
// Start here: seiche/simulation/solve.hpp is one call for one run, seiche/driver/run_case.hpp one for a case file and
// the folder that it leaves; seiche/simulation/simulation.hpp puts a problem, a method and a backend together, to step
// oneself; seiche/core/problem.hpp says what a problem is; seiche/method/methods.hpp and seiche/problem/problems.hpp
// list what there is.
#pragma once

#include <seiche/config/case/case_file.hpp>
#include <seiche/config/custom/custom_problem.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/core/observer.hpp>
#include <seiche/damping/formula_frictions.hpp>
#include <seiche/damping/frictions.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/driver/going_on.hpp>
#include <seiche/driver/run_case.hpp>
#include <seiche/driver/run_ensemble_case.hpp>
#include <seiche/law/law.hpp>
#include <seiche/loop/adaptive.hpp>
#include <seiche/loop/integrate.hpp>
#include <seiche/output/energy_trace.hpp>
#include <seiche/output/final_state.hpp>
#include <seiche/output/solution_reader.hpp>
#include <seiche/potential/bond.hpp>
#include <seiche/potential/nodal.hpp>
#include <seiche/potential/own_potential.hpp>
#include <seiche/potential/polynomials.hpp>
#include <seiche/problem/alpha_fpu.hpp>
#include <seiche/problem/beta_fpu.hpp>
#include <seiche/problem/burgers.hpp>
#include <seiche/problem/chain.hpp>
#include <seiche/problem/gkdv.hpp>
#include <seiche/problem/gradient_flow/pattern_formation.hpp>
#include <seiche/problem/gradient_flow/phase_separation.hpp>
#include <seiche/problem/klein_gordon.hpp>
#include <seiche/problem/network.hpp>
#include <seiche/problem/nls.hpp>
#include <seiche/problem/oscillator.hpp>
#include <seiche/problem/problems.hpp>
#include <seiche/problem/rigid_body.hpp>
#include <seiche/problem/sine_gordon.hpp>
#include <seiche/problem/sparse.hpp>
#include <seiche/problem/truss.hpp>
#include <seiche/problem/variable_wave.hpp>
#include <seiche/record/solution_file.hpp>
#include <seiche/simulation/simulation.hpp>
#include <seiche/simulation/solve.hpp>
#include <seiche/version.hpp>
