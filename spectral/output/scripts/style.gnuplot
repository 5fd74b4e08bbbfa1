# What every script begins with: CSV in, quiet axes and grid. Colours are those of Okabe and Ito or of
# viridis, for all kinds
# of colour vision; the canvas is white, so that pictures stand on light and dark pages.
set datafile separator comma
set border 3 lc rgb '#666666'
set tics nomirror textcolor rgb '#333333'
set grid lc rgb '#e4e4e4' lw 0.6
# A place on the page in six digits, as the program once printed them: pictures stay the same bytes.
six(place) = real(sprintf('%.6g', place))
