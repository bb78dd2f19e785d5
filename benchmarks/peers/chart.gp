# Bars of grain-steps per second from chart.csv in the folder `out`: each work, the fastest peer beside scree.
set datafile separator ','
set style data histograms
set style histogram clustered gap 1
set style fill solid
set ylabel 'million grain-steps per second (median)'
set yrange [0:*]
set xtics rotate by -25 left nomirror
set ytics nomirror
set border 3
set grid y
set key top right
set bmargin 5
set rmargin 8
array colours[4] = [0x808080, 0xa6cee3, 0x2c7fb8, 0x253494]
do for [kind in 'svg png'] {
  if (kind eq 'svg') {
    set terminal svg size 1000, 600
  } else {
    set terminal pngcairo size 1000, 600
  }
  set output out . '/peers.' . kind
  plot for [c = 2 : 5] out . '/chart.csv' using c:xtic(1) lc rgb colours[c - 1] title columnheader(c)
}
unset output
