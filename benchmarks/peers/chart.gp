# Bars of grain-steps per second from peers.csv in the folder `out`: median, and the best repeat as a tick above it.
set datafile separator ','
set style fill solid
set boxwidth 0.7
set ylabel 'million grain-steps per second'
set yrange [0:*]
set xtics rotate by -35 left nomirror
set ytics nomirror
set border 3
set grid y
set key top left
set bmargin 8
set rmargin 12
csv = out . '/peers.csv'
label(code, real, threads) = sprintf('%s, %s, %d', code, real, threads) . (threads > 1 ? ' threads' : ' thread')
lammps(code) = strstrt(code, 'LAMMPS') == 1
do for [kind in 'svg png'] {
  if (kind eq 'svg') {
    set terminal svg size 1000, 600
  } else {
    set terminal pngcairo size 1000, 600
  }
  set output out . '/peers.' . kind
  plot csv every ::1 using 0:($8 / 1e6):(lammps(stringcolumn(1)) ? 0x808080 : 0x2c7fb8): \
         xtic(label(stringcolumn(1), stringcolumn(4), $5)) with boxes lc rgb variable title 'median', \
       csv every ::1 using 0:($12 / 1e6) with points pt 1 ps 2 lc rgb 'black' title 'best'
}
unset output
