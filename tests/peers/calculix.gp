# Curves of the isotropic woven cell by both programs; called by
# cross_checks.py with picture, peer0, peer3, npt0, npt3.
set terminal svg size 900,380 font "sans,13" background "white"
set output picture
set datafile separator ","
set datafile commentschars "#"
set key top left
set xlabel "shear H_3 [-]"
set xrange [0:0.2]
set grid
set multiplot layout 1,2
set ylabel "n_3 [N/mm]"
s(c) = (strcol("stage") eq "shear" ? column(c) : NaN)
plot npt3 using (s("H3")):(s("n3")) with lines lw 2 lc rgb "#1f77b4" title "npt dealii, mu = 0.3", \
     peer3 using (s("H3")):(s("n3")) with points pt 6 lc rgb "#1f77b4" title "CalculiX, mu = 0.3", \
     npt0 using (s("H3")):(s("n3")) with lines lw 2 lc rgb "#d62728" title "npt dealii, mu = 0", \
     peer0 using (s("H3")):(s("n3")) with points pt 6 lc rgb "#d62728" title "CalculiX, mu = 0"
set ylabel "n_1 (circles), n_2 (triangles) [N/mm]"
plot npt3 using (s("H3")):(s("n1")) with lines lw 2 lc rgb "#1f77b4" notitle, \
     npt3 using (s("H3")):(s("n2")) with lines lw 2 dt 2 lc rgb "#1f77b4" notitle, \
     peer3 using (s("H3")):(s("n1")) with points pt 6 lc rgb "#1f77b4" title "mu = 0.3", \
     peer3 using (s("H3")):(s("n2")) with points pt 8 lc rgb "#1f77b4" notitle, \
     npt0 using (s("H3")):(s("n1")) with lines lw 2 lc rgb "#d62728" notitle, \
     npt0 using (s("H3")):(s("n2")) with lines lw 2 dt 2 lc rgb "#d62728" notitle, \
     peer0 using (s("H3")):(s("n1")) with points pt 6 lc rgb "#d62728" title "mu = 0", \
     peer0 using (s("H3")):(s("n2")) with points pt 8 lc rgb "#d62728" notitle
unset multiplot
