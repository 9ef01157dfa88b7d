# Draws the run against the closed form of README.md:
#   gnuplot prm/slip_front/picture.gp
# (from where ./run was called; -e "folder='...'" names another output folder)
if (!exists("folder")) folder = 'output/slip_front'
history = folder.'/history.csv'

# The numbers of slip_front.prm.
E = 206e3; h = 0.5; L = 100.; k_t = 1e3; tau = 0.58; u_m = 0.02

Lambda = sqrt(E*h/k_t)
N(l) = tau*Lambda*tanh((L - l)/Lambda)
F(l) = tau*l + N(l)
u(l) = tau/k_t + (N(l) + tau*l/2)*l/(E*h)

# Slip length at the reversal: u(l_m) = u_m.
lower = 0.; upper = L
do for [i = 1:60] {
  l_m = (lower + upper)/2
  if (u(l_m) < u_m) { lower = l_m } else { upper = l_m }
}

set encoding utf8
set terminal svg enhanced size 860,430 font 'DejaVu Sans,Verdana,sans-serif,13' background '#ffffff'
set datafile separator ','
set border 3 lw 1 lc rgb '#444444'
set tics nomirror out scale 0.6 textcolor rgb '#222222'
set grid lc rgb '#dddddd' lw 0.7 dt solid
set parametric
set trange [0:1]
set samples 300
set xlabel 'Displacement of the pulled end  [µm]'
set xrange [-22:22]

set output folder.'/force.svg'
set ylabel 'Force  [N/mm]'
set key left top Left reverse samplen 2.5 spacing 1.25
first(t) = t*l_m
plot \
  1e3*t*u(0), t*F(0) with lines lw 5 lc rgb '#bbbbbb' title 'closed form', \
  1e3*u(first(t)), F(first(t)) with lines lw 5 lc rgb '#bbbbbb' notitle, \
  1e3*(u_m - 2*t*u(0)), F(l_m) - 2*t*F(0) with lines lw 5 lc rgb '#bbbbbb' notitle, \
  1e3*(u_m - 2*u(first(t))), F(l_m) - 2*F(first(t)) with lines lw 5 lc rgb '#bbbbbb' notitle, \
  1e3*(2*t*u(0) - u_m), 2*t*F(0) - F(l_m) with lines lw 5 lc rgb '#bbbbbb' notitle, \
  1e3*(2*u(first(t)) - u_m), 2*F(first(t)) - F(l_m) with lines lw 5 lc rgb '#bbbbbb' notitle, \
  history using (1e3*column('displacement_mm')):(column('tangential_load_N')) \
    with lines lw 1.5 lc rgb '#0072B2' title 'slipstep'
set output

set output folder.'/front.svg'
set ylabel 'Slip length  [mm]'
set yrange [0:L]
set key center top Left reverse samplen 2.5 spacing 1.25
plot \
  1e3*u(first(t)), first(t) with lines lw 5 lc rgb '#bbbbbb' title 'closed form', \
  1e3*(u_m - 2*u(first(t))), first(t) with lines lw 5 lc rgb '#bbbbbb' notitle, \
  1e3*(2*u(first(t)) - u_m), first(t) with lines lw 5 lc rgb '#bbbbbb' notitle, \
  history using (1e3*column('displacement_mm')):(L*column('slip_fraction')) \
    with lines lw 1.5 lc rgb '#0072B2' title 'slipstep'
set output

# The mesh at the end: every cell of the contact face as a line at its size.
set output folder.'/mesh.svg'
set xlabel 'Distance from the free end  [mm]'
set ylabel 'Length of the cells  [mm]'
set xrange [0:L]
set yrange [0.25:8]
set logscale y 2
set key left top Left reverse samplen 2.5 spacing 1.25
set arrow 1 from first L - l_m, graph 0 to first L - l_m, graph 1 nohead lw 5 lc rgb '#bbbbbb' back
plot \
  NaN, NaN with lines lw 5 lc rgb '#bbbbbb' title 'front, closed form', \
  folder.'/contact_face.csv' using (column('x_mm')):(column('cell_size_x_mm')):(0.5*column('cell_size_x_mm')) \
    with xerrorbars pt 7 ps 0.25 lw 1.5 lc rgb '#0072B2' title 'slipstep'
set output
