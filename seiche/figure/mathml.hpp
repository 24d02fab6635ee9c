// Formulas as MathML, which browsers typeset without fonts or scripts.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace seiche {

// How a formula is written.
//   printed      as in the lists of this library: u_tt + γu_t − κΔu = 0, ½zᵀMz, u^{k+1}, L̇ = L × I⁻¹L. Letters side by
//                side are a product, small words of three letters and more are words.
//   case_file    as users write them: kappa/2*u_x^2, sqrt(1 + u^2), laplacian. Letters side by side are a name.
enum class Notation { printed, case_file };

// <math>…</math>. What has no meaning as a formula is there as it stands, so that every text has a result.
std::string mathml(std::string_view text, Notation notation);

// Parts of a formula, to be put together between <math> and </math>.
std::string mathml_part(std::string_view text, Notation notation);
std::string mathml_matrix(const std::vector<std::vector<std::string>>& rows);  // as in case files; parentheses by style

}  // namespace seiche
