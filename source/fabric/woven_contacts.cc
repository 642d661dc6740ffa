// SPDX-License-Identifier: LGPL-2.1-or-later
// Which surfaces of a weave's cell may touch.

#include <npt_dealii/fabric/woven_cell.h>

#include <cmath>

namespace NPT
{
  namespace
  {
    class ContactFinder
    {
    public:
      ContactFinder(const CellParameters                 &cell,
                    const WovenLattice                   &lattice,
                    const std::vector<SymmetryOperation> &shifts,
                    const std::vector<FiberBundle>       &bundles,
                    const std::vector<Strand>            &strands)
        : with_images_(cell.images)
        , by_warp_(cell.warp_secondary)
        , lattice_(lattice)
        , shifts_(shifts)
        , bundles_(bundles)
        , strands_(strands)
      {}

      // Every crossing of every secondary bundle: there the weft's top touches
      // the bottom of a warp strand that is over it, or its bottom the top of
      // one that is under it; the other way round if the warp is secondary.
      void
      add_crossings(std::vector<ContactCandidates> &contacts) const
      {
        for (unsigned int s = 0; s < bundles_.size(); ++s)
          {
            if (!is_secondary(s))
              continue;
            ContactCandidates pairs[2] = {{s, 0, {}}, {s, 1, {}}};
            for (unsigned int k = 0; k < strands_[s].n_crossings; ++k)
              {
                const bool above = primary_is_above(s, k);
                add_primaries(s, k, above, pairs[above ? 1 : 0].primaries);
              }
            for (ContactCandidates &pair : pairs)
              if (!pair.primaries.empty())
                contacts.push_back(pair);
          }
      }

      // The edge at the end of the direction across of every bundle against
      // the other edge of the next parallel strand. The edge at the begin needs
      // no pair of its own: a shift of the cell makes it the primary side here.
      // Each bundle counts once, since the 2-fold axis exchanges the roles.
      void
      add_edges(std::vector<ContactCandidates> &contacts) const
      {
        for (unsigned int s = 0; s < bundles_.size(); ++s)
          {
            const bool   warp = bundles_[s].family == FiberBundle::Family::warp;
            const int    along    = warp ? 0 : 1;
            const int    across   = 1 - along;
            const double across_L = lattice_.spacing(across);
            const double along_L  = lattice_.spacing(along);
            // The weft is the warp turned by +90 degrees: its direction across
            // points to -Y1.
            const double position =
              strands_[s].position + (warp ? across_L : -across_L);
            const double begin = strands_[s].begin, length = strands_[s].length;
            ContactCandidates pair{s, 1, {}, 1};
            for (unsigned int b = 0; b < bundles_.size(); ++b)
              for (const SymmetryOperation &g : shifts_)
                {
                  const double other_begin = strands_[b].begin + g.a[along];
                  if (bundles_[b].family != bundles_[s].family ||
                      std::abs(strands_[b].position + g.a[across] - position) >
                        1e-6 * across_L ||
                      other_begin > begin + length + 0.9 * along_L ||
                      other_begin + strands_[b].length < begin - 0.9 * along_L)
                    continue;
                  const int period =
                    std::lround((other_begin - begin) / strands_[b].length);
                  pair.primaries.push_back({b, 0, g, 0., 0, period, 1});
                }
            if (!pair.primaries.empty())
              contacts.push_back(pair);
          }
      }

    private:
      bool
      is_secondary(const unsigned int b) const
      {
        return bundles_[b].family == (by_warp_ ? FiberBundle::Family::warp :
                                                 FiberBundle::Family::weft);
      }

      // At crossing k of a secondary bundle.
      bool
      primary_is_above(const unsigned int s, const unsigned int k) const
      {
        const WeavePattern &weave    = lattice_.weave();
        const int           crossing = strands_[s].first + static_cast<int>(k);
        return by_warp_ ? !weave.warp_is_over(strands_[s].index, crossing) :
                          weave.warp_is_over(crossing, strands_[s].index);
      }

      // The piece of a primary strand that crosses there, and its continuations
      // as far as a sheared contact zone can reach: half a spacing beyond.
      void
      add_primaries(const unsigned int         s,
                    const unsigned int         k,
                    const bool                 above,
                    std::vector<SurfaceImage> &faces) const
      {
        // Component along the secondary bundle, and spacings of its crossings
        // and of those of a primary strand.
        const unsigned int along   = by_warp_ ? 0 : 1;
        const unsigned int across  = 1 - along;
        const double       along_L = lattice_.spacing(along);
        const double       other_L = lattice_.spacing(across);
        const int          origin =
          lattice_.axis() ? (*lattice_.axis())[across] : 0; // twice
        const int    crossing    = strands_[s].first + static_cast<int>(k);
        const double Y_secondary = strands_[s].position;
        const double Y_primary   = (crossing - 0.5 * origin) * along_L;
        for (unsigned int b = 0; b < bundles_.size(); ++b)
          for (const SymmetryOperation &g : shifts_)
            {
              if (is_secondary(b) ||
                  std::abs(strands_[b].position + g.a[along] - Y_primary) >
                    1e-6 * along_L)
                continue;
              const double length = strands_[b].length;
              const double begin  = strands_[b].begin + g.a[across];
              const bool   crosses =
                begin < Y_secondary && Y_secondary < begin + length;
              const bool near = begin < Y_secondary + 0.9 * other_L &&
                                begin + length > Y_secondary - 0.9 * other_L;
              if (!crosses && !(near && with_images_))
                continue;
              SurfaceImage image;
              image.bundle      = b;
              image.side        = (above ? 0 : 1) ^ (g.turns_over() ? 1 : 0);
              image.operation   = g;
              image.offset_sign = above ? 1. : -1.;
              image.strand      = k;
              image.period =
                crosses ?
                  0 :
                  std::lround((begin + 0.5 * length - Y_secondary) / length);
              if (!crosses && image.period == 0)
                image.period = begin > Y_secondary ? 1 : -1;
              faces.push_back(image);
            }
      }

      const bool                            with_images_;
      const bool                            by_warp_;
      const WovenLattice                   &lattice_;
      const std::vector<SymmetryOperation> &shifts_;
      const std::vector<FiberBundle>       &bundles_;
      const std::vector<Strand>            &strands_;
    };
  } // namespace



  std::vector<ContactCandidates>
  find_contacts(const CellParameters                 &cell,
                const WovenLattice                   &lattice,
                const std::vector<SymmetryOperation> &shifts,
                const std::vector<FiberBundle>       &bundles,
                const std::vector<Strand>            &strands)
  {
    const ContactFinder finder(cell, lattice, shifts, bundles, strands);
    std::vector<ContactCandidates> contacts;
    finder.add_crossings(contacts);
    if (cell.side_contact == CellParameters::SideContact::on)
      finder.add_edges(contacts);
    return contacts;
  }
} // namespace NPT
