# Draws the pictures of doc/load_cases.md and of lesson 01 from the results of
# prm/*.prm:
#   npt_dealii prm/tension.prm --output results/tension     (and so on)
#   gnuplot -e "results='results'" doc/images/load_cases.gp
if (!exists("results")) results = 'results'
if (!exists("images")) images = 'doc/images'
set datafile separator comma
set datafile columnheaders
set terminal svg size 560,360 font 'sans-serif,13' background 'white' dynamic
set style line 1 linecolor rgb '#0072b2' linewidth 2 pointtype 7 pointsize 0.4
set style line 2 linecolor rgb '#d55e00' linewidth 2 pointtype 5 pointsize 0.4
set style line 3 linecolor rgb '#009e73' linewidth 2 pointtype 9 pointsize 0.5
set grid linecolor rgb '#dddddd' linetype 1 linewidth 1
set border 3
set tics nomirror out
set key left top reverse Left samplen 2

file(name) = results.'/'.name.'/curves.csv'
of(stages) = strstrt(stages, '|'.strcol('stage').'|') > 0

# Shear of lesson 01; once more with --set 'Friction/Friction coefficient=0' to results/shear_mu0.
set output images.'/shear_curve.svg'
set xlabel 'shear H_3 [-]'; set ylabel 'n_3 [N/mm]'
plot file('shear') using (column('H3')):(of('|release|shear|') ? column('n3') : NaN) with linespoints ls 2 title 'friction 0.3', \
     file('shear_mu0') using (column('H3')):(of('|release|shear|') ? column('n3') : NaN) with linespoints ls 1 title 'without friction'

set output images.'/tension.svg'
set xlabel 'stretch H_1 [-]'; set ylabel 'resultants [N/mm]'
plot file('tension') using (column('H1')):(of('|release|tension|') ? column('n1') : NaN) with linespoints ls 1 title 'n_1', \
     '' using (column('H1')):(of('|release|tension|') ? column('n2') : NaN) with linespoints ls 2 title 'n_2 (width held)'

set output images.'/pretension_shear.svg'
set xlabel 'shear H_3 [-]'; set ylabel 'n_3 [N/mm]'
plot file('pretension_shear') using (column('H3')):(of('|pretension|shear|') ? column('n3') : NaN) with linespoints ls 1 title 'n_1 = n_2 = 2 N/mm', \
     file('shear') using (column('H3')):(of('|release|shear|') ? column('n3') : NaN) with linespoints ls 2 title 'H_1 = H_2 = 0'

set output images.'/biaxial.svg'
set xlabel 'stretch H_1, H_2 [-]'; set ylabel 'n_1 = n_2 [N/mm]'
plot file('biaxial') using (column('H1')):(of('|biaxial|') ? column('n1') : NaN) with linespoints ls 1 title 'over H_1', \
     '' using (column('H2')):(of('|biaxial|') ? column('n2') : NaN) with linespoints ls 2 title 'over H_2'

set output images.'/bending.svg'
set xlabel 'bending H_4 [1/mm]'; set ylabel 'n_4 [N]'
plot file('bending') using (column('H4')):(of('|relax|bend|') ? column('n4') : NaN) with linespoints ls 1 notitle

set output images.'/torsion.svg'
set xlabel 'torsion H_6 [1/mm]'; set ylabel 'n_6 [N]'
plot file('torsion') using (column('H6')):(of('|relax|twist|') ? column('n6') : NaN) with linespoints ls 1 notitle

set output images.'/cyclic_shear.svg'
set xlabel 'shear H_3 [-]'; set ylabel 'n_3 [N/mm]'
plot file('cyclic_shear') using (column('H3')):(of('|load|reverse|back|') ? column('n3') : NaN) with linespoints ls 1 notitle

set output images.'/cyclic_bending.svg'
set xlabel 'bending H_4 [1/mm]'; set ylabel 'n_4 [N]'
plot file('cyclic_bending') using (column('H4')):(of('|load|reverse|back|') ? column('n4') : NaN) with linespoints ls 1 notitle

# Once more with --set 'Cell/Side contact=off' to results/locking_off.
set output images.'/locking.svg'
set xlabel 'shear H_3 [-]'; set ylabel 'n_3 [N/mm]'
plot file('locking') using (column('H3')):(of('|shear|') ? column('n3') : NaN) with linespoints ls 1 title 'with side contact', \
     file('locking_off') using (column('H3')):(of('|shear|') ? column('n3') : NaN) with linespoints ls 2 title 'without'
