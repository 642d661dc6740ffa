// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines how a run learns that somebody wants it to end.

#ifndef npt_dealii_base_interruption_h
#define npt_dealii_base_interruption_h

namespace NPT
{
  /**
   * While an object of this class lives, the first SIGINT (Ctrl-C) or SIGTERM
   * does not end the program but sets a flag. Load steps ask for it, so that a
   * run ends with complete results. A second signal ends the program at once.
   *
   * There may be one object at a time; its destructor restores what was.
   */
  class Interruption
  {
  public:
    Interruption();
    ~Interruption();

    Interruption(const Interruption &) = delete;
    Interruption &
    operator=(const Interruption &) = delete;

    /// Whether a signal has come. False if there is no object.
    static bool
    requested();

    /// End the program by the signal that has come, so that a shell sees that
    /// it was interrupted; returns if there was none.
    static void
    end_by_signal();

  private:
    void (*old_interrupt_)(int);
    void (*old_terminate_)(int);
  };
} // namespace NPT

#endif
