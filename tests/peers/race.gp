# Error of n3(H3) over CPU time of both programs; called by race.py with
# picture, table. Points are errors; lines join the bounds of the runs whose bound
# is smaller than that of every cheaper one.
set terminal svg size 640,420 font "sans,13" background "white"
set output picture
set datafile separator ","
set datafile commentschars "#"
set datafile missing NaN
set logscale xy
set grid
set key top right
set xlabel "user CPU time of the whole process [s]"
set ylabel "relative L_2 error of n_3(H_3) [%]"
e(p) = (strcol("program") eq p ? 100 * column("error_common") : NaN)
f(p) = (strcol("program") eq p && column("front") == 1 ? 100 * column("bound_common") : NaN)
plot table using (column("cpu_seconds")):(f("npt_dealii")) with lines lw 2 lc rgb "#1f77b4" notitle, \
     table using (column("cpu_seconds")):(e("npt_dealii")) with points pt 7 lc rgb "#1f77b4" title "npt dealii", \
     table using (column("cpu_seconds")):(f("CalculiX")) with lines lw 2 lc rgb "#d62728" notitle, \
     table using (column("cpu_seconds")):(e("CalculiX")) with points pt 6 lc rgb "#d62728" title "CalculiX"
