#include <seiche/core/numerics/congruence.hpp>

namespace seiche {

template Eigen::MatrixXd congruence(const Eigen::MatrixXd& P, const Eigen::MatrixXd& B);
template Eigen::MatrixXcd congruence(const Eigen::MatrixXcd& P, const Eigen::MatrixXcd& B);

}  // namespace seiche
