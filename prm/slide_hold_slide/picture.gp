# Draws the peaks after the rests against the closed form of README.md:
#   gnuplot prm/slide_hold_slide/picture.gp
# (from where ./run was called; -e "folder='...'" names another output folder)
if (!exists("folder")) folder = 'output/slide_hold_slide/point'

# The numbers of slide_hold_slide.prm.
mu_s = 0.0915; mu_k = 0.078; kappa = 0.05; a = 10.; xi = 5e-7; b = 600.
eta = 1.15e4; n = 16.52; r_m = 1.8
array V[3] = [1., 10., 100.]   # mm/min
array colour[3] = ['#0072B2', '#D55E00', '#009E73']
first = 30.; length = 10.
array rest[6] = [1., 10., 100., 1e3, 1e4, 1e5]

# r(V): eta V (r_m - r) = exp(n (r - 1)) - 1; mu(V): softening and healing
# balance.
array r[3]
array mu[3]
do for [i = 1:3] {
  lower = 1.; upper = r_m
  do for [j = 1:50] {
    x = (lower + upper)/2
    if (exp(n*(x - 1)) - 1 < eta*V[i]/60*(r_m - x)) { lower = x } else { upper = x }
  }
  r[i] = lower
  lower = mu_k; upper = mu_s
  do for [j = 1:50] {
    x = (lower + upper)/2
    if (xi*(exp(b*(mu_s - x)) - 1) > kappa*(exp(a*(x - mu_k)) - 1)*V[i]/60) { lower = x } else { upper = x }
  }
  mu[i] = lower
}
healed(i, t) = mu_s + log(1 - (1 - exp(-b*(mu_s - mu[i])))*exp(-b*xi*t))/b

# The largest friction of every slide after a rest.
set datafile separator ','
array peak[18]
do for [i = 1:3] {
  file = sprintf('%s/%g_mm-min/history.csv', folder, V[i])
  do for [j = 1:6] {
    left = first + (j - 1)*length
    stats file using ((d = column('displacement_mm')) > left && d <= left + length ? column('friction') : NaN) nooutput
    peak[6*(i - 1) + j] = STATS_max
  }
}

set encoding utf8
set terminal svg enhanced size 860,430 font 'DejaVu Sans,Verdana,sans-serif,13' background '#ffffff'
set border 3 lw 1 lc rgb '#444444'
set tics nomirror out scale 0.6 textcolor rgb '#222222'
set grid lc rgb '#dddddd' lw 0.7 dt solid
set xlabel 'Time at rest  [s]'
set ylabel 'Peak friction after it  (tangential / normal load)'
set logscale x
set format x '10^{%T}'
set xrange [0.1:1e6]
set yrange [0.1:0.145]
set samples 400
set key left top Left reverse samplen 2.5 spacing 1.25
set output folder.'/healing.svg'
plot for [i = 1:3] r[i]*healed(i, x) with lines lw 4 lc rgb '#bbbbbb' \
    title (i == 1 ? 'r(V) µ(t), closed form' : ''), \
  for [i = 3:1:-1] rest using (rest[$1]):(peak[6*(i - 1) + $1]) \
    with points pt 3 + 2*i ps 0.9 lw 2 lc rgb colour[i] title sprintf('slipstep, %g mm/min', V[i])
set output
