#include "reference/ipc/barrier.hpp"

namespace ogc::reference {

Second<1> barrier_slopes(double gap, double support) {
  Second<1> variable(gap);
  variable.slope[0] = 1;
  return barrier(variable, support);
}

}  // namespace ogc::reference
