# kappa a by regression, as a table and a picture, and the kinetic level over
# speed by eq. 4, by Table 3 and by what levels.prm finds:
#   gnuplot prm/identify_flat_surface/picture.gp
# (from where ./run was called; -e "folder='...'" names another output folder)
if (!exists("folder")) folder = 'output/identify_flat_surface'
here = 'prm/identify_flat_surface'
system('mkdir -p '.folder)
set fit quiet
set fit logfile '/dev/null'
set fit errorvariables
set print '-'

# Displacement, friction, slope over windows of so many rows, 0.2 mm apart.
slope(noise, rows, way) = sprintf('<awk -v rows=%d -v way=%s -f %s/slope.awk %s/softening/noise_%s.csv', \
  rows, way, here, here, noise)
print 'd mu/ds = -p (mu - mu_k):           p = kappa a [1/mm]           mu_k'
do for [noise in '0 5e-4'] {
  do for [way in 'difference line'] {
    do for [n in '1 5 25 50'] {
      rows = way eq 'difference' ? n + 1 : int(n)
      if (rows > 1) {
        p = 0.05
        mu_k = 0.098
        fit -p*(x - mu_k) slope(noise, rows, way) using 2:3 via p, mu_k
        print sprintf('noise %-4s  %-10s over %4.1f mm   %8.5f +- %.5f   %8.5f +- %.5f', \
          noise, way, 0.2*(rows - 1), p, p_err, mu_k, mu_k_err)
      }
    }
  }
}
print 'd mu/ds = -kappa (exp(a (mu - mu_k)) - 1):'
do for [noise in '0 5e-4'] {
  rows = noise eq '0' ? 2 : 25
  way = noise eq '0' ? 'difference' : 'line'
  kappa = 0.06
  a = 0.8
  mu_k = 0.098
  fit -kappa*(exp(a*(x - mu_k)) - 1) slope(noise, rows, way) using 2:3 via kappa, a, mu_k
  print sprintf('noise %-4s  %-10s over %4.1f mm   kappa = %.4f +- %.2g /mm, a = %.3f +- %.2g', \
    noise, way, 0.2*(rows - 1), kappa, kappa_err, a, a_err)
}

set encoding utf8
set terminal svg enhanced size 860,430 font 'DejaVu Sans,Verdana,sans-serif,13' background '#ffffff'
set border 3 lw 1 lc rgb '#444444'
set tics nomirror out scale 0.6 textcolor rgb '#222222'
set grid lc rgb '#dddddd' lw 0.7 dt solid
set key opaque right top Left reverse samplen 2 spacing 1.25

set output folder.'/regression.svg'
set xlabel 'Friction'
set ylabel 'Change of friction with slip  [1/m]'
set xrange [0.096:0.117]
set yrange [-5:5]
p1 = 0.05; p2 = 0.05; k1 = k2 = 0.098
fit [*:*] -p1*(x - k1) slope('5e-4', 2, 'difference') using 2:3 via p1, k1
fit [*:*] -p2*(x - k2) slope('5e-4', 50, 'line') using 2:3 via p2, k2
plot slope('5e-4', 2, 'difference') using 2:(1e3*$3) with points pt 7 ps 0.35 lc rgb '#bbbbbb' \
       title 'differences of neighbours', \
     -1e3*p1*(x - k1) with lines lw 2 dt (8,5) lc rgb '#777777' title sprintf('  regression: {/:Italic κa} = %.3f /mm', p1), \
     slope('5e-4', 50, 'line') using 2:(1e3*$3) with points pt 7 ps 0.9 lc rgb '#D55E00' \
       title 'straight lines through 10 mm', \
     -1e3*p2*(x - k2) with lines lw 2 lc rgb '#D55E00' title sprintf('  regression: {/:Italic κa} = %.3f /mm', p2), \
     -45*(x - 0.098) with lines lw 2 lc rgb '#0072B2' title 'Table 2: {/:Italic κa} = 0.045 /mm'
set output

set output folder.'/levels.svg'
# eq. 3: the loading ratio at V mm/min, by Newton's method from above.
newton(r, v, eta, n) = r - (exp(n*(r - 1)) - 1 - eta*v*(1.8 - r))/(n*exp(n*(r - 1)) + eta*v)
n4(r, v, eta, n) = newton(newton(newton(newton(r, v, eta, n), v, eta, n), v, eta, n), v, eta, n)
from(v, eta, n) = 1 + log(1 + 0.8*eta*v)/n
ratio(V, eta, n) = n4(n4(from(V/60, eta, n), V/60, eta, n), V/60, eta, n)
eq4(V) = 4.20e-3*log(V) + 0.100
set logscale x
set format x '%g'
set xlabel 'Speed  [mm/min]'
set ylabel 'Kinetic friction'
set xrange [1e-4:1000]
set yrange [0.07:0.13]
set samples 400
set key left top
array V[4] = [1, 10, 50, 200]
plot eq4(x) with lines lw 5 lc rgb '#cccccc' title 'eq. 4', \
     V using (V[$1]):(eq4(V[$1])) with points pt 7 ps 1 lc rgb '#222222' title 'the four speeds', \
     0.078*ratio(x, 1.15e4, 16.52) with lines lw 2 dt (8,5) lc rgb '#0072B2' title 'Table 3', \
     0.078*ratio(x, 9600, 15.79) with lines lw 2 lc rgb '#0072B2' title 'found, with {/:Italic μ}_{k0} = 0.078 held', \
     0.0874*ratio(x, 1250, 18.6) with lines lw 2 lc rgb '#D55E00' title 'found, with {/:Italic μ}_{k0} fitted, too'
set output
