// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines how a member of a parameter struct becomes an entry of a parameter
// file: its default, its pattern, its text and its reading in one line.

#ifndef npt_dealii_base_parameter_binding_h
#define npt_dealii_base_parameter_binding_h

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/nearest_name.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace NPT
{
  /**
   * The values of an enum and their names in a parameter file, the order being
   * that of the documentation.
   */
  template <typename E>
  using EnumNames = std::vector<std::pair<E, std::string>>;

  /// To be specialized for every enum that a parameter file chooses, beside
  /// the enum.
  template <typename E>
  const EnumNames<E> &
  enum_names();

  template <typename E>
  const std::string &
  name_of(const E value)
  {
    for (const auto &[choice, name] : enum_names<E>())
      if (choice == value)
        return name;
    AssertThrow(false, dealii::ExcMessage("A value of an enum has no name."));
    return enum_names<E>().front().second;
  }

  /// All names as the argument of dealii::Patterns::Selection.
  template <typename E>
  std::string
  selection()
  {
    std::string names;
    for (const auto &item : enum_names<E>())
      names += (names.empty() ? "" : "|") + item.second;
    return names;
  }

  /// Throws InputError with the nearest name if there is none of this name.
  template <typename E>
  E
  value_of(const std::string &name)
  {
    std::vector<std::string> names;
    for (const auto &[value, choice] : enum_names<E>())
      {
        if (choice == name)
          return value;
        names.push_back(choice);
      }
    std::string list;
    for (const std::string &choice : names)
      list += (list.empty() ? "" : ", ") + choice;
    throw InputError("'" + name + "' is none of " + list +
                     did_you_mean(name, names));
  }

  /**
   * A value as a parameter file writes it. A specialization has three static
   * functions: text(value), value(text) with value(text(x)) == x exactly, and
   * pattern(), which may be narrower where the entry is added.
   */
  template <typename T, typename Enable = void>
  struct EntryValue;

  template <>
  struct EntryValue<double>
  {
    /// As few digits as give the same number again, "2e-5".
    static std::string
    text(const double value);
    static double
    value(const std::string &text);
    static std::unique_ptr<dealii::Patterns::PatternBase>
    pattern();
  };

  template <>
  struct EntryValue<unsigned int>
  {
    static std::string
    text(const unsigned int value);
    static unsigned int
    value(const std::string &text);
    static std::unique_ptr<dealii::Patterns::PatternBase>
    pattern();
  };

  template <>
  struct EntryValue<bool>
  {
    static std::string
    text(const bool value);
    static bool
    value(const std::string &text);
    static std::unique_ptr<dealii::Patterns::PatternBase>
    pattern();
  };

  template <>
  struct EntryValue<std::string>
  {
    static std::string
    text(const std::string &value);
    static std::string
    value(const std::string &text);
    static std::unique_ptr<dealii::Patterns::PatternBase>
    pattern();
  };

  template <typename E>
  struct EntryValue<E, std::enable_if_t<std::is_enum<E>::value>>
  {
    static std::string
    text(const E value)
    {
      return name_of(value);
    }
    static E
    value(const std::string &text)
    {
      return value_of<E>(text);
    }
    static std::unique_ptr<dealii::Patterns::PatternBase>
    pattern()
    {
      return std::make_unique<dealii::Patterns::Selection>(selection<E>());
    }
  };

  /// The parts of a list that is separated by commas.
  std::vector<std::string>
  split_list(const std::string &text);

  template <typename T>
  struct EntryValue<std::vector<T>>
  {
    static std::string
    text(const std::vector<T> &values)
    {
      std::string result;
      for (const T &value : values)
        result += (result.empty() ? "" : ", ") + EntryValue<T>::text(value);
      return result;
    }
    static std::vector<T>
    value(const std::string &text)
    {
      std::vector<T> result;
      for (const std::string &part : split_list(text))
        result.push_back(EntryValue<T>::value(part));
      return result;
    }
    static std::unique_ptr<dealii::Patterns::PatternBase>
    pattern()
    {
      return std::make_unique<dealii::Patterns::List>(
        *EntryValue<T>::pattern());
    }
  };

  /// A choice together with its name.
  template <typename E>
  struct EntryValue<std::pair<std::string, E>>
  {
    static std::string
    text(const std::pair<std::string, E> &value)
    {
      return value.first;
    }
    static std::pair<std::string, E>
    value(const std::string &text)
    {
      return {text, value_of<E>(text)};
    }
    static std::unique_ptr<dealii::Patterns::PatternBase>
    pattern()
    {
      return EntryValue<E>::pattern();
    }
  };

  /// The program chooses what is not there; the file then says `automatic`.
  template <typename T>
  struct EntryValue<std::optional<T>>
  {
    static_assert(std::is_enum<T>::value || std::is_same<T, bool>::value,
                  "Only choices can be left to the program.");

    static std::string
    text(const std::optional<T> &value)
    {
      return value ? EntryValue<T>::text(*value) : "automatic";
    }
    static std::optional<T>
    value(const std::string &text)
    {
      if (text == "automatic")
        return {};
      return EntryValue<T>::value(text);
    }
    static std::unique_ptr<dealii::Patterns::PatternBase>
    pattern()
    {
      if constexpr (std::is_enum<T>::value)
        return std::make_unique<dealii::Patterns::Selection>("automatic|" +
                                                             selection<T>());
      else
        return std::make_unique<dealii::Patterns::Selection>(
          "automatic|true|false");
    }
  };

  /// Numbers > 0.
  inline dealii::Patterns::Double
  positive_number()
  {
    return dealii::Patterns::Double(std::numeric_limits<double>::min());
  }

  /**
   * Declare an entry in the present subsection whose default is the present
   * value of a member, and which writes into this member whenever it is set.
   *
   * dealii::ParameterHandler::add_parameter() does the same for numbers and
   * texts; it knows no enums, writes 2e-5 as 2e-05, and no more than six
   * digits of a number.
   *
   * @param prm           No longer used after the member is gone or moved.
   * @param entry         Name in the file.
   * @param member        Its present value must match the pattern.
   * @param documentation What it is, symbol of doc/theory.md, unit.
   * @param pattern       What is allowed; by default all values of the type.
   */
  template <typename T>
  void
  add_parameter(
    dealii::ParameterHandler            &prm,
    const std::string                   &entry,
    T                                   &member,
    const std::string                   &documentation,
    const dealii::Patterns::PatternBase &pattern = *EntryValue<T>::pattern())
  {
    prm.declare_entry(entry,
                      EntryValue<T>::text(member),
                      pattern,
                      documentation);
    prm.add_action(entry, [&member](const std::string &text) {
      member = EntryValue<T>::value(text);
    });
  }

  /**
   * The same for what no single member holds.
   *
   * @param text Default.
   * @param read Called with every text that the entry is set to, and at once
   *   with the default. May throw InputError for what a pattern cannot express.
   */
  void
  add_parameter(dealii::ParameterHandler                       &prm,
                const std::string                              &entry,
                const std::string                              &text,
                const std::function<void(const std::string &)> &read,
                const std::string                              &documentation,
                const dealii::Patterns::PatternBase            &pattern);

  /// Within a subsection for the life of this object, left also by an
  /// exception.
  class ParameterSubsection
  {
  public:
    ParameterSubsection(dealii::ParameterHandler &prm, const std::string &name)
      : prm_(prm)
    {
      prm_.enter_subsection(name);
    }

    ~ParameterSubsection()
    {
      prm_.leave_subsection();
    }

    ParameterSubsection(const ParameterSubsection &) = delete;
    ParameterSubsection &
    operator=(const ParameterSubsection &) = delete;

  private:
    dealii::ParameterHandler &prm_;
  };
} // namespace NPT

#endif
