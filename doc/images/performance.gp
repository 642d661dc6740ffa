# Draws doc/images/performance.svg from the results of scripts/benchmark:
#   gnuplot -e "results='build/output-benchmark'" doc/images/performance.gp
if (!exists("results")) results = 'build/output-benchmark'
if (!exists("images")) images = 'doc/images'
set datafile separator comma
set datafile columnheaders
set terminal svg size 900,380 font 'sans-serif,13' background 'white' dynamic
set grid linecolor rgb '#dddddd' linetype 1 linewidth 1
set border 3
set tics nomirror out
set logscale xy
set format xy '10^{%L}'
set key left top reverse Left samplen 2
file = results.'/benchmark.csv'
# Woven from a coarser mesh on one process, and on two.
one(c) = c[1:5] eq 'weave' && strstrt(c, '@') == 0 && strstrt(c, '_s') == 0 && strstrt(c, '_I') == 0
two(c) = c[1:5] eq 'weave' && strstrt(c, '@2') > 0 && strstrt(c, '_s') == 0
pick(is, name) = is ? column(name) : NaN
set output images.'/performance.svg'
set multiplot layout 1,2
set xlabel 'free unknowns'
set xrange [1000:1e6]
set yrange [0.05:1e5] # room for the key
set ylabel 'seconds'
plot file using (column('unknowns')):(pick(one(strcol('case')), 'wall')) with points linecolor rgb '#0072b2' pointtype 7 title 'whole run, 1 process', \
     '' using (column('unknowns')):(pick(two(strcol('case')), 'wall')) with points linecolor rgb '#d55e00' pointtype 5 title '2 processes', \
     '' using (column('unknowns')):(pick(one(strcol('case')), 'factorize')) with points linecolor rgb '#0072b2' pointtype 6 title 'factorize', \
     '' using (column('unknowns')):(pick(one(strcol('case')), 'bundles')) with points linecolor rgb '#009e73' pointtype 9 title 'bundles', \
     '' using (column('unknowns')):(pick(one(strcol('case')), 'contact')) with points linecolor rgb '#cc79a7' pointtype 11 title 'contact', \
     [1000:1e6] 1e-4 * x with lines linecolor rgb '#888888' dashtype 2 title 'linear', \
     [1000:1e6] 2e-6 * x**1.5 with lines linecolor rgb '#888888' dashtype 3 title 'unknowns^{1.5}'
set ylabel 'GB, sum of the processes'
set yrange [0.1:300]
plot file using (column('unknowns')):(pick(one(strcol('case')), 'gigabytes')) with points linecolor rgb '#0072b2' pointtype 7 title '1 process', \
     '' using (column('unknowns')):(pick(two(strcol('case')), 'gigabytes')) with points linecolor rgb '#d55e00' pointtype 5 title '2 processes', \
     [1000:1e6] 4e-5 * x with lines linecolor rgb '#888888' dashtype 2 title 'linear'
unset multiplot
