# Error of n3(H3) over unknowns and over CPU time for the three bases; called
# by cross_checks.py with picture, table.
set terminal svg size 900,380 font "sans,13" background "white"
set output picture
set datafile separator ","
set datafile commentschars "#"
set logscale xy
set format y "10^{%T}"
set grid
set ylabel "relative L_2 error of n_3(H_3) [-]"
e(b) = (strcol("basis") eq b && column("difference_n3") > 0 ? column("difference_n3") : NaN)
set multiplot layout 1,2
set xlabel "free unknowns [-]"
do for [i = 1:2] {
  abscissa = i == 1 ? "unknowns" : "cpu_seconds"
  if (i == 2) { set xlabel "CPU time [s]" }
  plot table using (column(abscissa)):(e("NURBS")) with linespoints lw 2 pt 7 lc rgb "#1f77b4" title "NURBS, C1", \
       table using (column(abscissa)):(e("Bernstein")) with linespoints lw 2 pt 6 lc rgb "#d62728" title "Bernstein, C0", \
       table using (column(abscissa)):(e("Lagrange")) with linespoints lw 2 pt 2 lc rgb "#2ca02c" title "Lagrange (FE\\_Q)"
}
unset multiplot
