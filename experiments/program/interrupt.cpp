#include "experiments/program/interrupt.hpp"

#include <csignal>

namespace ogc::experiments {

namespace {
volatile std::sig_atomic_t interrupt_flag = 0;
extern "C" void set_interrupt_flag(int) { interrupt_flag = 1; }
}  // namespace

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = set_interrupt_flag;
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool interrupted() { return interrupt_flag != 0; }

}  // namespace ogc::experiments
