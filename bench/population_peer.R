# The peer: linear mixed models of per-event moduli with lme4, as the field fits them (dclab, R-lme4).
#
#     Rscript bench/population_peer.R MODULI.tsv > PEER.tsv
#
# MODULI.tsv has the columns experiment, condition (control, drug), session and ln_modulus, a line for each event
# (bench/populations.py peer writes it). Of each experiment the model ln E ~ condition + (1 + condition | session) is
# fitted and compared with ln E ~ 1 + (1 + condition | session) by the likelihood ratio, and also by the t test of the
# fixed effect with as many degrees of freedom as there are sessions less one. Output: experiment, difference of ln E,
# its standard error, p by the likelihood ratio, p by t, seconds.
suppressPackageStartupMessages(library(lme4))

arguments <- commandArgs(trailingOnly = TRUE)
events <- read.delim(arguments[1])
events$condition <- factor(events$condition, levels = c("control", "drug"))
events$session <- factor(events$session)

fitted <- function(own) {
  start <- proc.time()[["elapsed"]]
  quiet <- lmerControl(check.conv.singular = "ignore", check.conv.grad = "ignore", check.conv.hess = "ignore")
  full <- lmer(ln_modulus ~ condition + (1 + condition | session), own, REML = FALSE, control = quiet)
  null <- lmer(ln_modulus ~ 1 + (1 + condition | session), own, REML = FALSE, control = quiet)
  by_restricted <- lmer(ln_modulus ~ condition + (1 + condition | session), own, control = quiet)
  effect <- coef(summary(by_restricted))["conditiondrug", ]
  freedom <- nlevels(droplevels(own$session)) - 1
  data.frame(experiment = own$experiment[1], difference = effect[["Estimate"]], error = effect[["Std. Error"]],
             p_ratio = anova(full, null)[["Pr(>Chisq)"]][2], p_t = 2 * pt(-abs(effect[["t value"]]), freedom),
             seconds = proc.time()[["elapsed"]] - start)
}

write.table(do.call(rbind, lapply(split(events, events$experiment), fitted)), sep = "\t", quote = FALSE, row.names = FALSE)
