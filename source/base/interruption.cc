// SPDX-License-Identifier: LGPL-2.1-or-later
// The flag that SIGINT and SIGTERM set.

#include <npt_dealii/base/interruption.h>

#include <csignal>

namespace NPT
{
  namespace
  {
    volatile std::sig_atomic_t signal_that_came = 0;
    bool                       listening        = false;

    void
    note(const int signal)
    {
      signal_that_came = signal;
      std::signal(signal, SIG_DFL); // the second one ends the program
    }
  } // namespace



  Interruption::Interruption()
  {
    signal_that_came = 0;
    listening        = true;
    old_interrupt_   = std::signal(SIGINT, note);
    old_terminate_   = std::signal(SIGTERM, note);
    // Who starts a program in the background may have it ignore Ctrl-C.
    if (old_interrupt_ == SIG_IGN)
      std::signal(SIGINT, SIG_IGN);
  }



  Interruption::~Interruption()
  {
    listening = false;
    std::signal(SIGINT, old_interrupt_);
    std::signal(SIGTERM, old_terminate_);
  }



  bool
  Interruption::requested()
  {
    return listening && signal_that_came != 0;
  }



  void
  Interruption::end_by_signal()
  {
    if (signal_that_came == 0)
      return;
    std::signal(signal_that_came, SIG_DFL);
    std::raise(signal_that_came);
  }
} // namespace NPT
