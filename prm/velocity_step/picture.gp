# Draws the run against the closed form of README.md:
#   gnuplot prm/velocity_step/picture.gp
# (from where ./run was called; -e "folder='...'" names another output folder)
if (!exists("folder")) folder = 'output/velocity_step/point'

# The numbers of velocity_step.prm.
mu_s = 0.0915; mu_k = 0.078; kappa = 0.05; a = 10.; xi = 8.3e-4; b = 10.
eta = 1.15e4; n = 16.52; r_m = 1.8
array V[5] = [1., 10., 100., 10., 1.]   # mm/min
length = 20.

# r(V): eta V (r_m - r) = exp(n (r - 1)) - 1
array r[5]
array mu[5]
do for [i = 1:5] {
  lower = 1.; upper = r_m
  do for [j = 1:50] {
    x = (lower + upper)/2
    if (exp(n*(x - 1)) - 1 < eta*V[i]/60*(r_m - x)) { lower = x } else { upper = x }
  }
  r[i] = lower
  # mu(V): softening and healing balance.
  lower = mu_k; upper = mu_s
  do for [j = 1:50] {
    x = (lower + upper)/2
    if (xi*(exp(b*(mu_s - x)) - 1) > kappa*(exp(a*(x - mu_k)) - 1)*V[i]/60) { lower = x } else { upper = x }
  }
  mu[i] = lower
}

set encoding utf8
set terminal svg enhanced size 860,430 font 'DejaVu Sans,Verdana,sans-serif,13' background '#ffffff'
set datafile separator ','
set border 3 lw 1 lc rgb '#444444'
set tics nomirror out scale 0.6 textcolor rgb '#222222'
set grid lc rgb '#dddddd' lw 0.7 dt solid
set xlabel 'Displacement  [mm]'
set ylabel 'Friction  (tangential / normal load)'
set xrange [0:100]
set yrange [0.095:0.125]
set key right top Left reverse samplen 2.5 spacing 1.25 width -7
set output folder.'/levels.svg'
do for [i = 1:5] {
  set arrow i from (i - 1)*length, r[i]*mu[i] to i*length, r[i]*mu[i] nohead lw 6 lc rgb '#bbbbbb' back
  set label i sprintf('%g mm/min', V[i]) at (i - 0.5)*length, 0.0965 center textcolor rgb '#444444'
  if (i > 1) {
    set object i circle at (i - 1)*length, r[i]*mu[i-1] size screen 0.007 front fillstyle empty border lc rgb '#D55E00' lw 2
  }
}
plot NaN with lines lw 6 lc rgb '#bbbbbb' title 'r(V) µ(V), steady', \
  NaN with points pt 6 lw 2 lc rgb '#D55E00' title 'r(V) µ(V before), at the step', \
  folder.'/history.csv' using (column('displacement_mm')):(column('friction')) \
    with lines lw 1.8 lc rgb '#0072B2' title 'slipstep'
set output
