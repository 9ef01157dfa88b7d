# Draws the spring's load over the motion of the load point, and the limit of
# stability over speed:
#   gnuplot prm/stick_slip/picture.gp
# (from where ./run was called; -e "folder='...'" names another output folder)
if (!exists("folder")) folder = 'output/stick_slip/point'
array name[4] = ['0.1', '1', '3', '20']
array colour[4] = ['#0072B2', '#D55E00', '#009E73', '#CC79A7']

set encoding utf8
set terminal svg enhanced size 860,600 font 'DejaVu Sans,Verdana,sans-serif,13' background '#ffffff'
set datafile separator ','
set border 3 lw 1 lc rgb '#444444'
set tics nomirror out scale 0.6 textcolor rgb '#222222'
set grid lc rgb '#dddddd' lw 0.7 dt solid
set output folder.'/spring.svg'
set multiplot layout 4,1 margins 0.09,0.98,0.12,0.98 spacing 0,0.03
set xrange [0:6]
set yrange [0:0.34]
set ytics 0.1
unset key
do for [i = 1:4] {
  if (i < 4) { set format x ''; unset xlabel } else { set format x '%g'; set xlabel 'Displacement of the load point  [mm]' }
  if (i == 2) { set ylabel 'Load of the spring / normal load' offset 0,-4 } else { unset ylabel }
  set label 1 name[i].' mm/s' at graph 0.98, graph 0.12 right textcolor rgb colour[i]
  plot folder.'/'.name[i].'_mm-s/history.csv' every 4 using (column('displacement_mm')):(column('probe_3')) \
    with lines lw 1.6 lc rgb colour[i]
}
unset multiplot
set output

# The numbers of stick_slip.prm.
mu_s = 0.3; mu_k = 0.2; kappa = 10.; a = 2.; xi = 5.; b = 2.
eta = 100.; n = 100.; r_m = 1.8; alpha = 500.; p = 5.; m = 1e-5
newton(r, v) = r - (exp(n*(r - 1)) - 1 - eta*v*(r_m - r))/(n*exp(n*(r - 1)) + eta*v)
n4(r, v) = newton(newton(newton(newton(r, v), v), v), v)
r(v) = n4(n4(n4(n4(1 + log(1 + eta*v)/n, v), v), v), v)
slope(v) = eta*(r_m - r(v))/(n*exp(n*(r(v) - 1)) + eta*v)
g(u, v) = xi*(exp(b*(mu_s - u)) - 1) - kappa*(exp(a*(u - mu_k)) - 1)*v
dg(u, v) = -xi*b*exp(b*(mu_s - u)) - kappa*a*exp(a*(u - mu_k))*v
step(u, v) = u - g(u, v)/dg(u, v)
s3(u, v) = step(step(step(u, v), v), v)
mu(v) = s3(s3(mu_k, v), v)
C(v) = kappa*(exp(a*(mu(v) - mu_k)) - 1)
B(v) = kappa*a*exp(a*(mu(v) - mu_k))*v + xi*b*exp(b*(mu_s - mu(v)))
k0(v) = p*(r(v)*C(v) - mu(v)*slope(v)*B(v))
kc(v, m) = k0(v)/(1 - k0(v)/alpha) + m*k0(v)*B(v)/(p*mu(v)*slope(v))
positive(x) = x > 0 ? x : NaN

set terminal svg enhanced size 860,430 font 'DejaVu Sans,Verdana,sans-serif,13' background '#ffffff'
set output folder.'/stability.svg'
unset label
set key right top Left reverse samplen 2.5 spacing 1.25
set logscale xy
set format xy '%g'
set xrange [0.001:100]
set yrange [0.1:20]
set ytics auto
set samples 600
set xlabel 'Speed of the load point  [mm/s]'
set ylabel 'Stiffness of the machine  [MPa/mm]'  offset 0,0
set label 1 'stick-slip' at 0.1, 1.6 center textcolor rgb '#444444'
set label 2 'steady sliding' at 0.1, 14 center textcolor rgb '#444444'
array v[4] = [0.1, 1, 3, 20]
plot positive(kc(x, m)) with lines lw 3 lc rgb '#0072B2' title 'critical, with the mass', \
  positive(kc(x, 0)) with lines lw 2 dt (8,5) lc rgb '#0072B2' title 'critical, without mass', \
  v using ($1 < 4 ? v[$1] : NaN):(1.) with points pt 7 ps 1 lc rgb '#D55E00' title 'runs that stick and slip', \
  v using ($1 == 4 ? v[$1] : NaN):(1.) with points pt 6 ps 1 lw 2 lc rgb '#D55E00' title 'run that becomes steady'
set output
