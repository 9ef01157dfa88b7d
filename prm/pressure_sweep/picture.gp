# Draws the friction at the end of every slide against the closed forms of
# README.md:
#   gnuplot prm/pressure_sweep/picture.gp
# (from where ./run was called; -e "folder='...'" names another output folder)
if (!exists("folder")) folder = 'output/pressure_sweep/point'

# The numbers of pressure_sweep.prm.
mu = 0.078; m = 0.1; p0 = 5.8; tau_c = 6.; c = 0.05; V = 10./60
eta = 1.15e4; n = 16.52; r_m = 1.8
array p[9] = [0.5, 1., 2., 5., 10., 20., 50., 100., 200.]

# r(V): eta V (r_m - r) = exp(n (r - 1)) - 1
lower = 1.; upper = r_m
do for [j = 1:50] {
  r = (lower + upper)/2
  if (exp(n*(r - 1)) - 1 < eta*V*(r_m - r)) { lower = r } else { upper = r }
}

# The last 0.1 mm of the slide under each pressure.
set datafile separator ','
array name[4] = ['constant', 'pressure_exponent', 'shear_cap', 'adhesion']
array found[36]
do for [i = 1:4] {
  do for [j = 1:9] {
    stats folder.'/'.name[i].'/history.csv' \
      using (column('pressure_MPa') == p[j] && column('displacement_mm') > j - 0.1 ? column('friction') : NaN) nooutput
    found[9*(i - 1) + j] = STATS_mean
  }
}

set encoding utf8
set terminal svg enhanced size 860,430 font 'DejaVu Sans,Verdana,sans-serif,13' background '#ffffff'
set border 3 lw 1 lc rgb '#444444'
set tics nomirror out scale 0.6 textcolor rgb '#222222'
set grid lc rgb '#dddddd' lw 0.7 dt solid
set xlabel 'Pressure  [MPa]'
set ylabel 'Friction  (tangential / normal load)'
set logscale x
set xrange [0.4:250]
set yrange [0:0.3]
set samples 400
set key right top Left reverse samplen 2.5 spacing 1.25
set output folder.'/pressure.svg'
set style line 1 pt 4 ps 1.3 lw 2 lc rgb '#0072B2'
set style line 2 pt 7 ps 0.9 lc rgb '#D55E00'
set style line 3 pt 9 ps 0.8 lc rgb '#009E73'
set style line 4 pt 13 ps 1.1 lc rgb '#CC79A7'
plot r*(mu + c/x) with lines lw 3 lc rgb '#bbbbbb' title 'closed forms', \
  r*mu*(x/p0)**(-m) with lines lw 3 lc rgb '#bbbbbb' notitle, \
  r*mu with lines lw 3 lc rgb '#bbbbbb' notitle, \
  r*tau_c/x*tanh(mu*x/tau_c) with lines lw 3 lc rgb '#bbbbbb' notitle, \
  p using (p[$1]):(found[27 + $1]) with points ls 4 title 'adhesion', \
  p using (p[$1]):(found[9 + $1]) with points ls 2 title 'pressure exponent', \
  p using (p[$1]):(found[$1]) with points ls 1 title 'constant', \
  p using (p[$1]):(found[18 + $1]) with points ls 3 title 'shear cap'
set output
