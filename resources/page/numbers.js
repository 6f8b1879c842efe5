// Numbers for people, rounded as the program rounds them: an error decides which digits are shown.

// Decimals of a number with an absolute error: the place of the error's first digit.
function decimalsFor(value, error) {
  if (value === 0) return 0;
  const magnitude = Math.floor(Math.log10(Math.abs(value)));
  const most = 5 - magnitude;
  if (!(error > 0)) return most;
  return Math.min(Math.max(-Math.floor(Math.log10(error)), -magnitude), most);
}

// The number with so many decimals; negative for tens, hundreds.
function withDecimals(value, decimals) {
  const place = Math.pow(10, -decimals);
  const text = decimals < 0 ? String(Math.round(value / place) * place) : value.toFixed(Math.min(decimals, 9));
  return /[1-9]/.test(text) ? text : text.replace("-", "");
}

// "4.72 ± 0.03"
function withError(value, error) {
  const decimals = decimalsFor(value, error);
  const text = withDecimals(value, decimals);
  if (!(error > 0) || value === 0) return text;
  const place = Math.pow(10, -decimals);
  return text + " ± " + withDecimals(Math.ceil(error / place * (1 - 1e-9)) * place, decimals);
}

// Three significant digits.
function shortNumber(value) {
  return value === 0 ? "0" : withDecimals(value, 2 - Math.floor(Math.log10(Math.abs(value))));
}

function percent(relative) {
  return shortNumber(100 * relative) + " %";
}
