// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines registries: things of one kind that a parameter file chooses by name.

#ifndef npt_dealii_base_registry_h
#define npt_dealii_base_registry_h

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/nearest_name.h>

#include <deal.II/base/exceptions.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace NPT
{
  /**
   * All things of one kind by their names: materials, weaves, benchmark cases.
   * A new one is a pair of files with a registration at its end; no other file
   * changes:
   *
   * @code
   *   namespace
   *   {
   *     const Registry<NamedWeave>::Registration
   *       plain("plain", {"ou/uo", "over one, under one"});
   *   }
   * @endcode
   *
   * Registrations run before main(), in any order; names come out sorted, so
   * that nothing depends on that order.
   *
   * @tparam Entry What is known of one thing: a struct of functions and texts
   *   of the room that defines the kind.
   */
  template <typename Entry>
  class Registry
  {
  public:
    /// The one registry of this kind.
    static Registry &
    instance()
    {
      static Registry registry;
      return registry;
    }

    struct Registration
    {
      /// The name must not be taken.
      Registration(const std::string &name, Entry entry)
      {
        const bool is_new =
          instance().entries_.emplace(name, std::move(entry)).second;
        AssertThrow(is_new,
                    dealii::ExcMessage("'" + name + "' is registered twice."));
      }
    };

    /// All names, sorted.
    std::vector<std::string>
    names() const
    {
      std::vector<std::string> result;
      for (const auto &entry : entries_)
        result.push_back(entry.first);
      return result;
    }

    /// All names as the argument of dealii::Patterns::Selection.
    std::string
    selection() const
    {
      std::string result;
      for (const auto &entry : entries_)
        result += (result.empty() ? "" : "|") + entry.first;
      return result;
    }

    bool
    contains(const std::string &name) const
    {
      return entries_.count(name) > 0;
    }

    /// Throws InputError with the nearest name if there is none of this name.
    const Entry &
    get(const std::string &name) const
    {
      const auto found = entries_.find(name);
      if (found == entries_.end())
        throw InputError("'" + name + "' is none of the names known here" +
                         did_you_mean(name, names()));
      return found->second;
    }

  private:
    Registry() = default;

    std::map<std::string, Entry> entries_;
  };
} // namespace NPT

#endif
