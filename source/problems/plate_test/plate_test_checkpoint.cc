// SPDX-License-Identifier: LGPL-2.1-or-later
// Archive of a plate test, and which parameters fit it.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/fabric/fabric_cell.h>
#include <npt_dealii/io/checkpoint_file.h>
#include <npt_dealii/load_step/state_archive.h>
#include <npt_dealii/problems/plate_test/plate_test_checkpoint.h>

#include <deal.II/base/utilities.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/set.hpp>
#include <boost/serialization/utility.hpp>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <sstream>

namespace NPT
{
  namespace
  {
    // Of the archive below; raise it with every change there or in
    // state_archive.h.
    constexpr unsigned int checkpoint_version = 4;
  } // namespace



  // Found by Boost in the room of their arguments, so not in one without name.
  template <typename Archive>
  void
  serialize(Archive &archive, CurveRow &row, const unsigned int)
  {
    archive &row.step &row.stage &row.load_factor &row.H &row.n &row.N &row.M;
    archive &row.stored_energy &row.contact_energy &row.friction_energy;
    archive &row.dissipation &row.external_work &row.largest_penetration;
    archive &row.n_active &row.n_stick &row.n_slip &row.newton_iterations;
    archive &row.cuts &row.newton_order &row.cpu_seconds &row.further;
  }

  template <typename Archive>
  void
  serialize(Archive                  &archive,
            PlateTestResults::Memory &memory,
            const unsigned int)
  {
    archive &memory.curve &memory.bundle_files &memory.contact_files;
    archive &memory.cell_scripts &memory.stages_done &memory.energy_balance;
  }

  template <typename Archive>
  void
  serialize(Archive &archive, LinearSolverMemory &memory, const unsigned int)
  {
    archive &memory.is_indefinite &memory.needs_double;
  }

  template <typename Archive>
  void
  serialize(Archive &archive, StageEnd &end, const unsigned int)
  {
    archive &end.state &end.woven;
  }

  template <typename Archive>
  void
  serialize(Archive             &archive,
            PlateTestCheckpoint &checkpoint,
            const unsigned int)
  {
    archive &checkpoint.parameters &checkpoint.choices;
    archive &checkpoint.coarser_mesh &checkpoint.stage;
    archive &checkpoint.stage_start &checkpoint.start_woven &checkpoint.memory;
    archive &checkpoint.woven &checkpoint.not_elliptic_in;
    archive &checkpoint.overlap_warned_of &checkpoint.has_pattern;
    archive &checkpoint.couplings &checkpoint.solver_memory;
    archive &checkpoint.results &checkpoint.files &checkpoint.ends;
  }



  namespace
  {
    // The entries of a file as the program prints it, by their paths.
    std::map<std::string, std::string>
    entries_of(const std::string &text)
    {
      std::map<std::string, std::string> entries;
      std::vector<std::string>           path;
      std::istringstream                 lines(text);
      for (std::string line; std::getline(lines, line);)
        {
          line = dealii::Utilities::trim(line);
          if (line.compare(0, 11, "subsection ") == 0)
            path.push_back(dealii::Utilities::trim(line.substr(11)));
          else if (line == "end")
            path.pop_back();
          else if (line.compare(0, 4, "set ") == 0)
            {
              const std::size_t equal = line.find('=');
              std::string       name;
              for (const std::string &subsection : path)
                name += subsection + "/";
              name += dealii::Utilities::trim(line.substr(4, equal - 4));
              entries[name] = dealii::Utilities::trim(line.substr(equal + 1));
            }
        }
      return entries;
    }

    std::string
    value_of(const std::map<std::string, std::string> &entries,
             const std::string                        &name)
    {
      const auto found = entries.find(name);
      return found == entries.end() ? "" : found->second;
    }

    // 0.1 and 1e-1 are the same.
    bool
    same_value(const std::string &a, const std::string &b)
    {
      char        *end_a = nullptr, *end_b = nullptr;
      const double x = std::strtod(a.c_str(), &end_a),
                   y = std::strtod(b.c_str(), &end_b);
      const bool are_numbers =
        !a.empty() && !b.empty() && *end_a == '\0' && *end_b == '\0';
      return a == b || (are_numbers && x == y);
    }

    std::vector<std::string>
    stage_names(const std::map<std::string, std::string> &entries)
    {
      return dealii::Utilities::split_string_list(
        value_of(entries, "Load programme/Stages"), ',');
    }

    // Whether an entry may differ: what acts on the way only, and what lies
    // ahead.
    bool
    may_differ(const std::string              &entry,
               const std::vector<std::string> &stages_begun)
    {
      for (const std::string subsection : {"Newton/",
                                           "Linear solver/",
                                           "Stability/",
                                           "Output/",
                                           "Checkpoint/"})
        if (entry.compare(0, subsection.size(), subsection) == 0)
          return true;
      if (entry == "Load programme/Stages") // compared by its names
        return true;
      const std::string stage = "Load programme/Stage ";
      if (entry.compare(0, stage.size(), stage) != 0)
        return false;
      return std::none_of(stages_begun.begin(),
                          stages_begun.end(),
                          [&](const std::string &name) {
                            const std::string begun = stage + name + "/";
                            return entry.compare(0, begun.size(), begun) == 0;
                          });
    }

    void
    check_stages(const std::string              &filename,
                 const std::vector<std::string> &old_names,
                 const std::vector<std::string> &names,
                 const unsigned int              stage)
    {
      for (unsigned int i = 0; i <= stage; ++i)
        if (i >= names.size() || i >= old_names.size() ||
            names[i] != old_names[i])
          refuse_checkpoint(
            filename,
            "has begun stage " + std::to_string(i + 1) + ", " +
              (i < old_names.size() ? old_names[i] : "") +
              ", and in this file that stage is " +
              (i < names.size() ? names[i] : "missing") +
              "; only the stages behind the present one may differ (entry "
              "Stages, subsection Load programme)");
    }

    // A stage that lies ahead begins at the end of the present one, of one
    // that lies ahead as well, or of one whose end was kept.
    void
    check_starts(const std::string            &filename,
                 const PlateTestCheckpoint    &checkpoint,
                 const std::vector<LoadStage> &stages)
    {
      for (unsigned int k = checkpoint.stage + 1; k < stages.size(); ++k)
        {
          const unsigned int before = *stage_before(stages, k);
          if (before >= checkpoint.stage ||
              checkpoint.ends.count(stages[before].name) > 0)
            continue;
          refuse_checkpoint(filename,
                            "has not kept the end of stage " +
                              stages[before].name + ", where stage " +
                              stages[k].name +
                              " begins; begin anew, or set Start to another "
                              "stage (subsection Stage " +
                              stages[k].name + ")");
        }
    }

    PlateTestCheckpoint
    unpack(const std::string &filename, const std::string &contents)
    {
      PlateTestCheckpoint checkpoint;
      try
        {
          std::istringstream              in(contents);
          boost::archive::binary_iarchive archive(in);
          archive                        &checkpoint;
        }
      catch (const boost::archive::archive_exception &failure)
        {
          // The checksum is right, so somebody else's library wrote it.
          refuse_checkpoint(filename,
                            std::string("was written by another build of the "
                                        "program (") +
                              failure.what() + ")");
        }
      return checkpoint;
    }
  } // namespace



  void
  write_checkpoint(const std::string         &filename,
                   const PlateTestCheckpoint &checkpoint)
  {
    std::ostringstream out;
    {
      boost::archive::binary_oarchive archive(out);
      archive                        &checkpoint;
    }
    write_checkpoint_file(filename, checkpoint_version, out.str());
  }



  std::optional<PlateTestCheckpoint>
  read_checkpoint(const std::string         &directory,
                  const PlateTestParameters &parameters,
                  const Ranks               &ranks)
  {
    std::string contents, obstacle;
    std::string filename = directory + "/" + checkpoint_name;
    if (ranks.is_first())
      try
        {
          contents = read_checkpoint_file(filename, checkpoint_version)
                       .value_or(std::string());
        }
      catch (const InputError &error)
        {
          obstacle = error.what();
        }
    obstacle = ranks.broadcast(obstacle);
    if (!obstacle.empty())
      throw InputError(obstacle);
    filename = ranks.broadcast(filename);
    contents = ranks.broadcast(contents);
    if (contents.empty())
      return {};
    const PlateTestCheckpoint checkpoint = unpack(filename, contents);
    check_fit(filename, checkpoint, parameters);
    return checkpoint;
  }



  std::vector<std::string>
  check_fit(const std::string         &filename,
            const PlateTestCheckpoint &checkpoint,
            const PlateTestParameters &parameters)
  {
    auto       old_entries = entries_of(checkpoint.parameters);
    const auto entries     = entries_of(parameters.used_file);
    // Entries that the program that wrote it did not have: their defaults.
    for (const auto &item :
         entries_of(PlateTestParameters::documented_defaults()))
      if (entries.count(item.first) > 0 &&
          item.first.find("Load programme/Stage ") != 0)
        old_entries.insert(item);
    const std::vector<std::string> names = stage_names(entries);
    check_stages(filename, stage_names(old_entries), names, checkpoint.stage);
    const std::vector<std::string> begun(names.begin(),
                                         names.begin() + checkpoint.stage + 1);

    std::map<std::string, std::string> all = old_entries;
    all.insert(entries.begin(), entries.end());
    std::vector<std::string> differences;
    for (const auto &item : all)
      {
        const std::string &name      = item.first;
        const std::string  old_value = value_of(old_entries, name),
                          value      = value_of(entries, name);
        if (same_value(old_value, value))
          continue;
        const std::string difference =
          name + " = " + value + " instead of " + old_value;
        if (!may_differ(name, begun))
          refuse_checkpoint(filename,
                            "belongs to a run with other parameters: " +
                              difference);
        // Where results go is no difference.
        if (name != "Output/Directory")
          differences.push_back(difference);
      }
    check_starts(filename, checkpoint, parameters.load_programme.stages);
    const std::string choices = choices_of_program(parameters);
    if (choices != checkpoint.choices)
      refuse_checkpoint(filename,
                        "is of a run with " + checkpoint.choices +
                          ", and with the present stages the program chooses " +
                          choices + " (subsection Cell)");
    return differences;
  }



  std::string
  choices_of_program(const PlateTestParameters &parameters)
  {
    const CellParameters &cell = parameters.cell;
    return "Type = " + cell.type +
           ", Side contact = " + name_of(cell.side_contact) +
           ", Smooth closure = " + name_of(cell.smooth_closure) +
           (cell.mirror_planes == CellParameters::MirrorPlanes::yes ?
              ", Mirror planes = true" :
              "") +
           (FabricCell(cell, parameters.mesh).integrates_pieces() ?
              ", integrated in pieces" :
              "");
  }
} // namespace NPT
