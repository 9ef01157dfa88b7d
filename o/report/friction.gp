# Friction against displacement
# draw again: gnuplot friction.gp
set encoding utf8
set terminal svg enhanced size 860,430 font 'DejaVu Sans,Verdana,sans-serif,13' background '#ffffff'
set output 'friction.svg'
set border 3 lw 1 lc rgb '#444444'
set tics nomirror out scale 0.6 textcolor rgb '#222222'
set grid lc rgb '#dddddd' lw 0.7 dt solid
set key outside right top Left reverse samplen 2.5 spacing 1.25
set rmargin at screen 0.8884
set key at screen 0.9084, graph 1 left top
set xlabel 'Displacement of the drive  [mm]'
set ylabel 'Friction  (tangential / normal load)'
set xrange [-0.01:1.06]
set xzeroaxis lc rgb '#444444' lw 1 dt solid
plot 'friction.dat' index 0 with lines lw 2 lc rgb '#0072B2' dt solid title "b2"
set output
set print 'friction.axes'
print GPVAL_TERM_XMIN, GPVAL_TERM_XMAX, GPVAL_TERM_YMIN, GPVAL_TERM_YMAX, GPVAL_X_MIN, GPVAL_X_MAX, GPVAL_Y_MIN, GPVAL_Y_MAX
set print
