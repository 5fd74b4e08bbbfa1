# Size of a table against its largest error, a line per way to tabulate.
#   title    text
#   way[]    names of the ways
#   $sizes   bytes, error; an index per way
reset
set title title noenhanced font ',17'
set logscale xy
set xlabel 'size of the table (bytes)'
set ylabel 'largest |table - exact| / (exact + 10^{-3} peak)'
set format x '10^{%T}'
set format y '10^{%T}'
set grid lc rgb '#dddddd'
set yrange [1e-6:]
set key inside left bottom Left reverse noenhanced
set datafile separator comma
colours = '#999999 #e69f00 #56b4e9 #009e73 #d55e00'
plot for [i=1:|way|] $sizes index i-1 with linespoints lw 2.5 pt i+3 lc rgb word(colours, (i - 1) % 5 + 1) \
    title way[i]
