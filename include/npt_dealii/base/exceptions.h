// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the typed errors of the program: what a user can mend, what a load
// step may survive, and what ends a run with its results so far kept.

#ifndef npt_dealii_base_exceptions_h
#define npt_dealii_base_exceptions_h

#include <stdexcept>
#include <string>

namespace NPT
{
  /**
   * The input cannot be used: an unknown entry, a value out of range, an
   * impossible combination. The message is one sentence with the entry, the
   * value found, what is allowed, and where possible the nearest valid name.
   * The program prints it and ends with exit status 2 before computing.
   */
  class InputError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /**
   * A file of results cannot be written: the disk is full, a folder is read
   * only. The program prints the sentence and ends with exit status 4.
   */
  class OutputError : public std::runtime_error
  {
  public:
    /// @param reason What the system says, without a period.
    OutputError(const std::string &file, const std::string &reason)
      : std::runtime_error("The file '" + file +
                           "' cannot be written: " + reason + ".")
    {}
  };

  /**
   * A load step failed in a way that a smaller step may survive. The driver
   * catches exactly this family, restores the accepted state and cuts the
   * step; anything else is a bug and is not caught there.
   */
  class LoadStepFailure : public std::runtime_error
  {
  public:
    /**
     * @param reason Short name used in logs and stability maps, e.g.
     *   "inverted cell".
     * @param detail Where and with which figures, for a person to read.
     */
    LoadStepFailure(const std::string &reason, const std::string &detail)
      : std::runtime_error(reason + ": " + detail)
      , reason_(reason)
    {}

    const std::string &
    reason() const
    {
      return reason_;
    }

    /// What a user may try if no smaller step helps: half a sentence.
    virtual std::string
    advice() const
    {
      return "lower the Minimum step of the stage, lower the contact "
             "penalties, or raise Maximum iterations (subsection Newton)";
    }

  private:
    std::string reason_;
  };

  /// A failure whose cause is the state of the material itself.
  class MaterialFailure : public LoadStepFailure
  {
  public:
    using LoadStepFailure::LoadStepFailure;

    std::string
    advice() const override
    {
      return "the state itself may be the limit: look at the fields of the "
             "last accepted step, refine or reshape the mesh there, or lower "
             "the target";
    }
  };

  /// det F <= 0 (or not finite) at a quadrature point.
  class InvertedCell : public MaterialFailure
  {
  public:
    explicit InvertedCell(const std::string &detail)
      : MaterialFailure("inverted cell", detail)
    {}
  };

  /// A contact point has no usable closest point on the primary surface.
  class ProjectionLost : public LoadStepFailure
  {
  public:
    explicit ProjectionLost(const std::string &detail)
      : LoadStepFailure("projection lost", detail)
    {}
  };

  /// A contact point got deeper into the other body than it may.
  class PenetrationTooDeep : public LoadStepFailure
  {
  public:
    explicit PenetrationTooDeep(const std::string &detail)
      : LoadStepFailure("penetration too deep", detail)
    {}

    std::string
    advice() const override
    {
      return "raise the Normal penalty, or the Maximum penetration (subsection "
             "Contact), refine the mesh if the other bundle is narrower than a "
             "few elements, or lower the Minimum step of the stage";
    }
  };

  /// Newton ran out of iterations or of line search.
  class NewtonNotConverged : public LoadStepFailure
  {
  public:
    NewtonNotConverged(const std::string &reason, const std::string &detail)
      : LoadStepFailure(reason, detail)
    {}
  };

  /// Newton goes round between states of contact, or stands still.
  class NewtonStalled : public NewtonNotConverged
  {
  public:
    using NewtonNotConverged::NewtonNotConverged;

    std::string
    advice() const override
    {
      return "lower the contact penalties or switch on the line search "
             "(subsection Newton)";
    }
  };

  /// The linear solver met a singular matrix or did not converge.
  class LinearSolverFailed : public LoadStepFailure
  {
  public:
    explicit LinearSolverFailed(const std::string &detail)
      : LoadStepFailure("linear solver failed", detail)
    {}

    std::string
    advice() const override
    {
      return "look for bodies that nothing holds; give a weave a release "
             "stage, or try another Type in subsection Linear solver";
    }
  };

  /// The factors of the matrix do not fit into the memory.
  class OutOfMemory : public LoadStepFailure
  {
  public:
    explicit OutOfMemory(const std::string &detail)
      : LoadStepFailure("out of memory", detail)
    {}

    /// Also for memory that runs out elsewhere.
    static std::string
    remedy()
    {
      return "a coarser mesh (subsection Mesh), Type = ILU, which needs no "
             "factorization (subsection Linear solver), or a machine with more "
             "memory; shorter load steps need as much";
    }

    std::string
    advice() const override
    {
      return remedy();
    }
  };

  /// The acoustic tensor of a material lost its positive definiteness.
  class EllipticityLost : public MaterialFailure
  {
  public:
    explicit EllipticityLost(const std::string &detail)
      : MaterialFailure("loss of ellipticity", detail)
    {}
  };

  /// The macroscopic gradients leave nothing of the cell, see macro_limits.h.
  class CellCollapsed : public MaterialFailure
  {
  public:
    explicit CellCollapsed(const std::string &detail)
      : MaterialFailure("cell collapsed", detail)
    {}
  };

  /**
   * A stage cannot be finished: the step became smaller than allowed, memory
   * ran out, or somebody interrupted the run. Carries what happened and what to
   * try; results so far stay complete and readable.
   */
  class StageFailed : public std::runtime_error
  {
  public:
    /**
     * @param account What happened, for a person: stage, load factor, reason.
     * @param reason  Short name as in LoadStepFailure::reason().
     * @param stage   Name of the stage; results end in it at @p load_factor.
     * @param n_cuts  Failed load steps of the stage.
     * @param advice  What to try, half a sentence; or nothing. what() is the
     *   account with it.
     */
    StageFailed(const std::string &account,
                const std::string &reason      = "",
                const std::string &stage       = "",
                const double       load_factor = 0,
                const unsigned int n_cuts      = 0,
                const std::string &advice      = "")
      : std::runtime_error(
          account + (advice.empty() ? "" : " What to try: " + advice + "."))
      , account_(account)
      , reason_(reason)
      , stage_(stage)
      , advice_(advice)
      , load_factor_(load_factor)
      , n_cuts_(n_cuts)
    {}

    const std::string &
    account() const
    {
      return account_;
    }

    const std::string &
    reason() const
    {
      return reason_;
    }

    const std::string &
    stage() const
    {
      return stage_;
    }

    const std::string &
    advice() const
    {
      return advice_;
    }

    double
    load_factor() const
    {
      return load_factor_;
    }

    unsigned int
    n_cuts() const
    {
      return n_cuts_;
    }

  private:
    std::string  account_, reason_, stage_, advice_;
    double       load_factor_;
    unsigned int n_cuts_;
  };
} // namespace NPT

#endif
