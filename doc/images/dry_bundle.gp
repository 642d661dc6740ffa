# SPDX-License-Identifier: LGPL-2.1-or-later
# Draws the response of the law of dry bundles for doc/fabrics.md:
#   npt_dealii prm/dry_bundle.prm
#   gnuplot -e "table='output-dry-bundle/material_tests.csv'" doc/images/dry_bundle.gp > doc/images/dry_bundle.svg
set terminal svg size 960 620 font 'sans,12' background rgb 'white'
set datafile separator comma
set datafile commentschars '#'
set key top left Left reverse samplen 2
set xlabel offset 0, .4
set multiplot layout 2, 2

# Of one test, column y over column x.
of(test, x, y) = strcol('test') eq test ? column(y) : NaN
at(test, x) = strcol('test') eq test ? column(x) : NaN

set title 'along the fibers'
set xtics .001
set xlabel 'H_{11}'
set ylabel 'P_{11} [MPa]'
plot table using (at('tension', 'H11')):(of('tension', 'H11', 'P11')) with linespoints pt 7 ps .5 title 'tension', \
  table using (at('compression', 'H11')):(of('compression', 'H11', 'P11')) with linespoints pt 7 ps .5 title 'compression: fibers buckle'

set title 'across, from all sides'
set xtics autofreq
set xlabel '-H_{22} = -H_{33}'
set ylabel '-P_{33} [MPa]'
set logscale y
plot table using (-at('compaction', 'H33')):(-of('compaction', 'H33', 'P33')) with linespoints pt 7 ps .5 title 'fiber fraction .60 to .74'
unset logscale y

set title 'across, from two sides; the others are free'
set xlabel '-H_{33}'
plot table using (-at('press', 'H33')):(-of('press', 'H33', 'P33')) with linespoints pt 7 ps .5 notitle

set title 'shear'
set xlabel 'H_{13} or H_{23}'
set ylabel 'P_{13} or P_{23} [MPa]'
plot table using (at('slide', 'H13')):(of('slide', 'H13', 'P13')) with linespoints pt 7 ps .5 title 'along the fibers, P_{13}', \
  table using (at('shear', 'H23')):(of('shear', 'H23', 'P23')) with linespoints pt 7 ps .5 title 'across them, P_{23}'
unset multiplot
