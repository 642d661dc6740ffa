// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines how statements are checked against declarations, the sentences that
// tell a user what to change, and the documented print-out.

#include <npt_dealii/base/declared_parameters.h>
#include <npt_dealii/base/describe_pattern.h>
#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/message_words.h>
#include <npt_dealii/base/nearest_name.h>
#include <npt_dealii/base/parameter_file.h>
#include <npt_dealii/base/text_file.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <map>
#include <ostream>
#include <sstream>
#include <utility>

namespace NPT
{
  namespace
  {
    using Kind = ParameterText::Kind;
    using Path = std::vector<std::string>;

    // ---- Unknown names -----------------------------------------------------

    std::string
    in_subsection(const Path &path)
    {
      return path.empty() ? " outside all subsections" :
                            " in subsection " + in_quotes(joined(path, "/"));
    }

    std::string
    to_subsection(const Path &path)
    {
      return path.empty() ? "the top level" :
                            "subsection " + in_quotes(joined(path, "/"));
    }

    /// Call @p visit(path, section) for a section and all below it.
    template <typename Visitor>
    void
    visit_sections(const DeclaredSection &section,
                   Path                  &path,
                   const Visitor         &visit)
    {
      visit(path, section);
      for (const DeclaredSection &subsection : section.subsections)
        {
          path.push_back(subsection.name);
          visit_sections(subsection, path, visit);
          path.pop_back();
        }
    }

    /**
     * What to write instead of an unknown name: the place it belongs to, else
     * the nearest name here, else elsewhere, else all that would be valid here.
     *
     * @param names_of Gives the names of the wanted kind in a section.
     */
    template <typename NamesOf>
    std::string
    hint_for_unknown_name(const std::string     &name,
                          const DeclaredSection &top,
                          const DeclaredSection &here,
                          const std::string     &kind,
                          const NamesOf         &names_of)
    {
      std::vector<std::string> homes, names_elsewhere;
      Path                     path;
      visit_sections(top,
                     path,
                     [&](const Path &p, const DeclaredSection &section) {
                       for (const std::string &candidate : names_of(section))
                         {
                           names_elsewhere.push_back(candidate);
                           if (candidate == name)
                             homes.push_back(to_subsection(p));
                         }
                     });
      if (!homes.empty())
        {
          // More homes than a sentence can hold come from numbered sections
          // (Stage 1, Stage 2, ...); two of them make the point.
          if (homes.size() > 2)
            {
              homes.resize(2);
              homes.push_back("others");
            }
          return "; it belongs to " + joined(homes, " or ");
        }

      const std::vector<std::string> names_here = names_of(here);
      std::string                    hint = did_you_mean(name, names_here);
      if (!hint.empty())
        return hint;

      const auto nearest = nearest_names(name, names_elsewhere);
      if (!nearest.empty())
        {
          std::string home;
          path.clear();
          visit_sections(
            top, path, [&](const Path &p, const DeclaredSection &section) {
              const auto names = names_of(section);
              if (home.empty() &&
                  std::count(names.begin(), names.end(), nearest[0]) > 0)
                home = to_subsection(p);
            });
          return "; did you mean " + in_quotes(nearest[0]) + " of " + home +
                 "?";
        }
      return names_here.empty() ? "; there is no " + kind + " here" :
                                  "; valid here: " + listed(names_here);
    }

    std::string
    unknown_entry(const std::string     &name,
                  const Path            &path,
                  const DeclaredSection &top,
                  const DeclaredSection &here)
    {
      const std::string text =
        "unknown entry " + in_quotes(name) + in_subsection(path);
      if (here.find_subsection(name) != nullptr)
        return text + "; " + in_quotes(name) +
               " is a subsection and has no value itself";
      return text +
             hint_for_unknown_name(name,
                                   top,
                                   here,
                                   "entry",
                                   [](const DeclaredSection &s) {
                                     return s.entry_names();
                                   }) +
             pasted_character_hint(name);
    }

    std::string
    unknown_subsection(const std::string     &name,
                       const Path            &path,
                       const DeclaredSection &top,
                       const DeclaredSection &here)
    {
      const std::string text =
        "unknown subsection " + in_quotes(name) + in_subsection(path);
      if (here.find_entry(name) != nullptr)
        return text + "; " + in_quotes(name) + " is an entry, write 'set " +
               name + " = VALUE'";
      return text +
             hint_for_unknown_name(name,
                                   top,
                                   here,
                                   "subsection",
                                   [](const DeclaredSection &s) {
                                     return s.subsection_names();
                                   }) +
             pasted_character_hint(name);
    }


    // ---- Values ------------------------------------------------------------

    // What deal.II's patterns let through although it cannot be used; empty: it
    // can. The patterns read 1e-400 as 0, the conversion behind them fails.
    std::string
    fault_of(const std::string &value, const std::string &pattern)
    {
      if (pattern.compare(0, 14, "[DirectoryName") == 0)
        {
          if (value.empty())
            return "empty; it must be the name of a directory, '.' is the "
                   "present one";
          const std::string hint = home_folder_hint(value);
          return hint.empty() ? "" : in_quotes(value) + hint;
        }
      if (pattern.find("[Double") == std::string::npos)
        return "";
      const std::string fault = number_beyond_doubles(value);
      return fault.empty() ? "" :
                             in_quotes(value) + "; it must be " +
                               describe_pattern(pattern) + "; " + fault;
    }

    // deal.II sets the value or refuses it. Its own test decides, because the
    // description of a pattern has bounds rounded to six digits. What an entry
    // finds wrong itself gets its place as well.
    void
    set_value(dealii::ParameterHandler &prm,
              const Path               &path,
              const DeclaredEntry      &entry,
              const std::string        &value,
              const std::string        &where)
    {
      const std::string place =
        "entry " + in_quotes(entry.name) + in_subsection(path) + " is ";
      if (const std::string fault = fault_of(value, entry.pattern);
          !fault.empty())
        throw InputError(where + place + fault);

      for (const std::string &subsection : path)
        prm.enter_subsection(subsection);
      std::string message;
      try
        {
          prm.set(entry.name, value);
        }
      catch (const dealii::ParameterHandler::ExcValueDoesNotMatchPattern &)
        {
          message = place + (value.empty() ? "empty" : in_quotes(value)) +
                    "; it must be " + describe_pattern(entry.pattern) +
                    suggestion_for_value(value, entry.pattern);
        }
      catch (const InputError &error)
        {
          message = error.what();
        }
      for (std::size_t i = 0; i < path.size(); ++i)
        prm.leave_subsection();

      if (!message.empty())
        throw InputError(where + message);
    }



    /// An old name and its new one are the same entry.
    const DeclaredEntry &
    proper_entry(const DeclaredSection &section, const DeclaredEntry &entry)
    {
      const DeclaredEntry *proper =
        entry.alias_of.empty() ? &entry : section.find_entry(entry.alias_of);
      return proper == nullptr ? entry : *proper;
    }

    Path
    path_of(const Path &section, const DeclaredEntry &entry)
    {
      Path path = section;
      path.push_back(entry.name);
      return path;
    }



    // ---- Overrides ---------------------------------------------------------

    struct Override
    {
      Path        components;
      std::string value;
      bool        has_equal_sign;
    };

    Override
    split_override(const std::string &text)
    {
      const std::string::size_type equal = text.find('=');
      Override                     result;
      result.has_equal_sign = equal != std::string::npos;
      if (result.has_equal_sign)
        result.value = trim(text.substr(equal + 1));

      std::istringstream in(text.substr(0, equal));
      std::string        component;
      while (std::getline(in, component, '/'))
        result.components.push_back(trim(component));
      return result;
    }

    struct FoundEntry
    {
      Path                   path; ///< of its section
      const DeclaredSection *section = nullptr;
      const DeclaredEntry   *entry   = nullptr;
    };

    /// The entry that an override names; throws InputError beginning with
    /// @p where if there is none.
    FoundEntry
    find_entry_of_override(const DeclaredSection &top,
                           const Path            &components,
                           const std::string     &where)
    {
      // Names with a slash are found by the joined path as well.
      const std::string wanted = joined(components, "/");
      FoundEntry        found;
      Path              path;
      visit_sections(top,
                     path,
                     [&](const Path &p, const DeclaredSection &section) {
                       for (const DeclaredEntry &entry : section.entries)
                         if (joined(path_of(p, entry), "/") == wanted)
                           found = {p, &section, &entry};
                     });
      if (found.entry != nullptr)
        return found;

      const DeclaredSection *here = &top;
      for (std::size_t i = 0; i + 1 < components.size(); ++i)
        {
          const DeclaredSection *next = here->find_subsection(components[i]);
          if (next == nullptr)
            throw InputError(
              where + unknown_subsection(components[i], path, top, *here));
          here = next;
          path.push_back(components[i]);
        }
      throw InputError(where +
                       unknown_entry(components.back(), path, top, *here));
    }



    /// Stores statements of files and overrides of the command line.
    class ValueSetter
    {
    public:
      explicit ValueSetter(dealii::ParameterHandler &prm)
        : prm_(prm)
        , top_(declared_parameters(prm))
        , sections_{&top_}
      {}

      void
      apply(const ParameterText::Statement &statement)
      {
        const std::string      where = at_line(statement.file, statement.line);
        const DeclaredSection &here  = *sections_.back();
        switch (statement.kind)
          {
            case Kind::subsection:
              {
                const DeclaredSection *section =
                  here.find_subsection(statement.name);
                if (section == nullptr)
                  throw InputError(
                    where +
                    unknown_subsection(statement.name, path_, top_, here));
                sections_.push_back(section);
                path_.push_back(statement.name);
                break;
              }
            case Kind::end:
              AssertThrow(!path_.empty(), dealii::ExcInternalError());
              sections_.pop_back();
              path_.pop_back();
              break;
            case Kind::set:
              set(statement, where);
              break;
          }
      }

      void
      apply_override(const std::string &text)
      {
        const std::string where = "--set " + in_quotes(text) + ": ";
        const Override    split = split_override(text);
        if (!split.has_equal_sign)
          throw InputError(where +
                           "'=' is missing, write 'Subsection/Entry=value'");
        if (split.components.empty() || split.components.back().empty())
          throw InputError(where + "the name of the entry is missing, write "
                                   "'Subsection/Entry=value'");
        // It could be used, but not be written to a parameter file again.
        if (split.value.find('#') != std::string::npos)
          throw InputError(where + "the value contains '#', which begins a "
                                   "comment in a parameter file");

        const FoundEntry found =
          find_entry_of_override(top_, split.components, where);
        const DeclaredEntry &entry = proper_entry(*found.section, *found.entry);
        const auto [previous, is_new] =
          overrides_.emplace(path_of(found.path, entry), text);
        if (!is_new)
          throw InputError(
            where + "entry " + in_quotes(entry.name) +
            in_subsection(found.path) + " is already set by --set " +
            in_quotes(previous->second) + "; keep only one of the two");
        set_value(prm_, found.path, entry, split.value, where);
      }

    private:
      void
      set(const ParameterText::Statement &statement, const std::string &where)
      {
        const DeclaredSection &here  = *sections_.back();
        const DeclaredEntry   *named = here.find_entry(statement.name);
        if (named == nullptr)
          throw InputError(where +
                           unknown_entry(statement.name, path_, top_, here));
        const DeclaredEntry &entry = proper_entry(here, *named);

        const auto [previous, is_new] =
          lines_.emplace(std::make_pair(statement.file, path_of(path_, entry)),
                         statement.line);
        // The same line once more is a file included twice.
        if (!is_new && previous->second != statement.line)
          throw InputError(where + "entry " + in_quotes(entry.name) +
                           in_subsection(path_) + " is already set in line " +
                           std::to_string(previous->second) +
                           " of this file; keep only one of the two");
        set_value(prm_, path_, entry, statement.value, where);
      }

      dealii::ParameterHandler            &prm_;
      const DeclaredSection                top_;
      Path                                 path_; ///< of the present subsection
      std::vector<const DeclaredSection *> sections_;

      /// Where an entry was set: (file, path) -> line.
      std::map<std::pair<std::string, Path>, unsigned int> lines_;
      std::map<Path, std::string>                          overrides_;
    };
  } // namespace



  void
  parse_parameter_text(dealii::ParameterHandler       &prm,
                       const ParameterText            &text,
                       const std::vector<std::string> &overrides)
  {
    ValueSetter setter(prm);
    for (const ParameterText::Statement &statement : text.statements)
      setter.apply(statement);
    for (const std::string &override_text : overrides)
      setter.apply_override(override_text);
  }



  std::optional<std::string>
  get_entry(const ParameterText            &text,
            const std::vector<std::string> &overrides,
            const std::string              &path)
  {
    const std::string wanted = joined(split_override(path).components, "/");

    std::optional<std::string> value;
    Path                       current_path;
    for (const ParameterText::Statement &statement : text.statements)
      switch (statement.kind)
        {
          case Kind::subsection:
            current_path.push_back(statement.name);
            break;
          case Kind::end:
            current_path.pop_back();
            break;
          case Kind::set:
            current_path.push_back(statement.name);
            if (joined(current_path, "/") == wanted)
              value = statement.value;
            current_path.pop_back();
            break;
        }

    for (const std::string &override_text : overrides)
      {
        const Override split = split_override(override_text);
        if (split.has_equal_sign && joined(split.components, "/") == wanted)
          value = split.value;
      }
    return value;
  }



  namespace
  {
    void
    print_section(const DeclaredSection &section,
                  const unsigned int     depth,
                  std::ostream          &out)
    {
      const std::string indent(2 * depth, ' ');
      const auto        print_comment = [&](const std::string &text) {
        const int width = 80 - static_cast<int>(indent.size()) - 2;
        for (const std::string &line :
             dealii::Utilities::break_text_into_lines(text, width))
          {
            // A blank paragraph line would otherwise end in a blank.
            const std::string comment = trim(line);
            out << indent << (comment.empty() ? "#" : "# ") << comment << '\n';
          }
      };

      std::size_t name_width = 0;
      for (const std::string &name : section.entry_names())
        name_width = std::max(name_width, name.size());

      bool is_first = true;
      for (const DeclaredEntry &entry : section.entries)
        {
          if (!entry.alias_of.empty())
            continue;
          if (!is_first)
            out << '\n';
          is_first = false;

          if (!trim(entry.documentation).empty())
            print_comment(trim(entry.documentation));
          std::string allowed;
          if (entry.pattern != "[Anything]")
            allowed = "Allowed: " + describe_pattern(entry.pattern) + ". ";
          if (entry.value != entry.default_value)
            allowed +=
              "Default: " +
              (entry.default_value.empty() ? "empty" : entry.default_value) +
              ".";
          if (!allowed.empty())
            print_comment(trim(allowed));
          out << indent << "set " << entry.name
              << std::string(name_width - entry.name.size(), ' ') << " ="
              << (entry.value.empty() ? "" : " ") << entry.value << '\n';
        }

      for (const DeclaredSection &subsection : section.subsections)
        {
          if (!is_first)
            out << '\n';
          is_first = false;
          out << indent << "subsection " << subsection.name << '\n';
          print_section(subsection, depth + 1, out);
          out << indent << "end\n";
        }
    }
  } // namespace



  void
  print_documented_parameters(const dealii::ParameterHandler &prm,
                              std::ostream                   &out)
  {
    print_section(declared_parameters(prm), 0, out);
  }



  std::string
  documented_parameters(const dealii::ParameterHandler &prm)
  {
    std::ostringstream out;
    print_documented_parameters(prm, out);
    return out.str();
  }
} // namespace NPT
