#pragma once

namespace avoidbench {

/// P(Z <= z) of a standard normal Z; relative error below 1e-13 in both tails.
double normal_cdf(double z);

/// log Γ(x), x > 0; absolute error below 1e-14 max(1, |log Γ(x)|).
double log_gamma(double x);

/// log(n! / (k! (n - k)!)), 0 <= k <= n.
double log_choose(double n, double k);

/// P(B <= x) of a beta variable B, a, b > 0: the regularised incomplete beta function, by Lentz's
/// continued fraction; relative error near 1e-13 for a + b up to 1000.
double beta_cdf(double x, double a, double b);

/// The `p` quantile of a beta variable, by bisection to the last bit; `p` in [0, 1].
double beta_quantile(double p, double a, double b);

/// P(G <= x) of a gamma variable G of shape `a` > 0 and scale 1: the regularised incomplete gamma
/// function, by its series below a + 1 and Lentz's continued fraction above.
double gamma_cdf(double x, double a);

/// The `p` quantile of a gamma variable, by bisection to the last bit; `p` in [0, 1).
double gamma_quantile(double p, double a);

/// P(X <= k) of a binomial X of `n` trials with success probability `rate`.
double binomial_cdf(double k, double n, double rate);

/// P(T >= t) of a Student's t variable T with `freedom` > 0 degrees of freedom, t >= 0.
double student_t_tail(double t, double freedom);

/// The `p` quantile, in (0, 1), of Student's t with `freedom` > 0 degrees of freedom.
double student_t_quantile(double p, double freedom);

}  // namespace avoidbench
